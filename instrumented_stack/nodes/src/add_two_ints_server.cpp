// SPDX-License-Identifier: Apache-2.0
// Adds two numbers for clients of service add_two_ints.
//
// Parameter: count  end after this many requests (default 0: until interrupted)
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>

#include "example_interfaces/srv/add_two_ints.hpp"
#include "rclcpp/rclcpp.hpp"

class AddTwoIntsServer : public rclcpp::Node {
 public:
  using AddTwoInts = example_interfaces::srv::AddTwoInts;

  AddTwoIntsServer() : Node("add_two_ints_server") {
    count_ = declare_parameter("count", 0);
    service_ = create_service<AddTwoInts>(
        "add_two_ints", [this](std::shared_ptr<AddTwoInts::Request> request,
                               std::shared_ptr<AddTwoInts::Response> response) { add(*request, *response); });
    // The response to a request is sent after its callback, so the program must end later.
    end_timer_ = create_wall_timer(std::chrono::milliseconds(50), [this] {
      if (count_ != 0 && answered_ >= count_) {
        rclcpp::shutdown();
      }
    });
  }

 private:
  void add(const AddTwoInts::Request& request, AddTwoInts::Response& response) {
    response.sum = request.a + request.b;
    ++answered_;
    RCLCPP_INFO(get_logger(), "%ld + %ld = %ld", static_cast<long>(request.a), static_cast<long>(request.b),
                static_cast<long>(response.sum));
  }

  int64_t count_ = 0;
  int64_t answered_ = 0;
  rclcpp::Service<AddTwoInts>::SharedPtr service_;
  rclcpp::TimerBase::SharedPtr end_timer_;
};

int main(int argc, char** argv) {
  try {
    rclcpp::init(argc, argv);
    rclcpp::spin(std::make_shared<AddTwoIntsServer>());
    rclcpp::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "add_two_ints_server: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
