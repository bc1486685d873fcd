// SPDX-License-Identifier: Apache-2.0
// Asks service add_two_ints for a sum every two seconds.
#include <chrono>
#include <cinttypes>
#include <memory>

#include "example_interfaces/srv/add_two_ints.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace composition {

using AddTwoInts = example_interfaces::srv::AddTwoInts;

class Client : public rclcpp::Node {
 public:
  explicit Client(const rclcpp::NodeOptions& options);

 private:
  void ask();

  rclcpp::Client<example_interfaces::srv::AddTwoInts>::SharedPtr client_;
  rclcpp::TimerBase::SharedPtr timer_;
};

Client::Client(const rclcpp::NodeOptions& options) : Node("client", options) {
  client_ = create_client<AddTwoInts>("add_two_ints");
  timer_ = create_wall_timer(std::chrono::seconds(2), [this] { ask(); });
}

void Client::ask() {
  // A component must not wait for the server, because it may be a component of the same thread.
  if (!client_->service_is_ready()) {
    RCLCPP_INFO(get_logger(), "waiting for service %s", client_->get_service_name());
    return;
  }
  auto request = std::make_shared<AddTwoInts::Request>();
  request->a = 2;
  request->b = 3;
  client_->async_send_request(request, [this](rclcpp::Client<AddTwoInts>::SharedFuture future) {
    RCLCPP_INFO(get_logger(), "Got result: [%" PRId64 "]", future.get()->sum);
  });
}

}  // namespace composition

RCLCPP_COMPONENTS_REGISTER_NODE(composition::Client)
