// SPDX-License-Identifier: Apache-2.0
// Adds two numbers for clients of service add_two_ints.
#include <cinttypes>
#include <memory>

#include "example_interfaces/srv/add_two_ints.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace demo_nodes_cpp {

class ServerNode : public rclcpp::Node {
 public:
  using AddTwoInts = example_interfaces::srv::AddTwoInts;

  explicit ServerNode(const rclcpp::NodeOptions& options) : Node("add_two_ints_server", options) {
    service_ = create_service<AddTwoInts>("add_two_ints", [this](const std::shared_ptr<AddTwoInts::Request> request,
                                                                 std::shared_ptr<AddTwoInts::Response> response) {
      RCLCPP_INFO(get_logger(), "Incoming request\na: %" PRId64 " b: %" PRId64, request->a, request->b);
      response->sum = request->a + request->b;
    });
  }

 private:
  rclcpp::Service<AddTwoInts>::SharedPtr service_;
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::ServerNode)
