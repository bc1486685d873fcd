// SPDX-License-Identifier: Apache-2.0
// Asks service add_two_ints for a sum, and ends when the answer has come.
#include <chrono>
#include <cinttypes>
#include <memory>

#include "example_interfaces/srv/add_two_ints.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace demo_nodes_cpp {

class ClientNode : public rclcpp::Node {
 public:
  using AddTwoInts = example_interfaces::srv::AddTwoInts;

  explicit ClientNode(const rclcpp::NodeOptions& options) : Node("add_two_ints_client", options) {
    client_ = create_client<AddTwoInts>("add_two_ints");
    // Not done in the constructor, because a container that loads this node must not wait.
    timer_ = create_wall_timer(std::chrono::milliseconds(100), [this] { ask_once_there_is_a_server(); });
  }

 private:
  void ask_once_there_is_a_server() {
    if (!client_->service_is_ready()) {
      RCLCPP_INFO_THROTTLE(get_logger(), *get_clock(), 1000, "service not available, waiting again...");
      return;
    }
    timer_->cancel();
    auto request = std::make_shared<AddTwoInts::Request>();
    request->a = 2;
    request->b = 3;
    client_->async_send_request(request, [this](rclcpp::Client<AddTwoInts>::SharedFuture future) {
      RCLCPP_INFO(get_logger(), "Got result: [%" PRId64 "]", future.get()->sum);
      rclcpp::shutdown();
    });
  }

  rclcpp::Client<AddTwoInts>::SharedPtr client_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::ClientNode)
