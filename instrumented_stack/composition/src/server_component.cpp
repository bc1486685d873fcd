// SPDX-License-Identifier: Apache-2.0
// Adds two numbers for clients of service add_two_ints.
#include <cinttypes>
#include <memory>

#include "example_interfaces/srv/add_two_ints.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace composition {

class Server : public rclcpp::Node {
 public:
  explicit Server(const rclcpp::NodeOptions& options);

 private:
  rclcpp::Service<example_interfaces::srv::AddTwoInts>::SharedPtr service_;
};

Server::Server(const rclcpp::NodeOptions& options) : Node("server", options) {
  using AddTwoInts = example_interfaces::srv::AddTwoInts;
  service_ = create_service<AddTwoInts>("add_two_ints", [this](const std::shared_ptr<AddTwoInts::Request> request,
                                                               std::shared_ptr<AddTwoInts::Response> response) {
    response->sum = request->a + request->b;
    RCLCPP_INFO(get_logger(), "Incoming request: [a: %" PRId64 ", b: %" PRId64 "]", request->a, request->b);
  });
}

}  // namespace composition

RCLCPP_COMPONENTS_REGISTER_NODE(composition::Server)
