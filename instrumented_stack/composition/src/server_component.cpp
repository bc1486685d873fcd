// SPDX-License-Identifier: Apache-2.0
#include "composition/server_component.hpp"

#include <cinttypes>
#include <memory>

#include "rclcpp_components/register_node_macro.hpp"

namespace composition {

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
