// SPDX-License-Identifier: Apache-2.0
// Adds two numbers. If parameter service_configure_introspection enables it, publishes the requests taken and the
// responses sent on add_two_ints/_service_event.
#include <cinttypes>
#include <memory>

#include "example_interfaces/srv/add_two_ints.hpp"
#include "introspection_parameter.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace demo_nodes_cpp {

class IntrospectionServiceNode : public rclcpp::Node {
 public:
  using AddTwoInts = example_interfaces::srv::AddTwoInts;

  explicit IntrospectionServiceNode(const rclcpp::NodeOptions& options)
      : Node("introspection_service", options),
        service_(create_service<AddTwoInts>(
            "add_two_ints",
            [this](const std::shared_ptr<AddTwoInts::Request> request, std::shared_ptr<AddTwoInts::Response> response) {
              RCLCPP_INFO(get_logger(), "Incoming request\na: %" PRId64 " b: %" PRId64, request->a, request->b);
              response->sum = request->a + request->b;
            })),
        introspection_(*this, "service_configure_introspection", [this](rcl_service_introspection_state_t state) {
          service_->configure_introspection(get_clock(), rclcpp::SystemDefaultsQoS(), state);
        }) {}

 private:
  rclcpp::Service<AddTwoInts>::SharedPtr service_;
  IntrospectionParameter introspection_;
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::IntrospectionServiceNode)
