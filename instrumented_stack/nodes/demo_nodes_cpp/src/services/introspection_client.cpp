// SPDX-License-Identifier: Apache-2.0
// Asks for a sum twice a second. If parameter client_configure_introspection enables it, publishes the requests sent
// and the responses taken on add_two_ints/_service_event.
#include <chrono>
#include <cinttypes>
#include <memory>

#include "example_interfaces/srv/add_two_ints.hpp"
#include "introspection_parameter.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace demo_nodes_cpp {

class IntrospectionClientNode : public rclcpp::Node {
 public:
  using AddTwoInts = example_interfaces::srv::AddTwoInts;

  explicit IntrospectionClientNode(const rclcpp::NodeOptions& options)
      : Node("introspection_client", options),
        client_(create_client<AddTwoInts>("add_two_ints")),
        introspection_(*this, "client_configure_introspection",
                       [this](rcl_service_introspection_state_t state) {
                         client_->configure_introspection(get_clock(), rclcpp::SystemDefaultsQoS(), state);
                       }),
        timer_(create_wall_timer(std::chrono::milliseconds(500), [this] { ask(); })) {}

 private:
  // One request at a time.
  void ask() {
    if (is_waiting_ || !client_->service_is_ready()) {
      return;
    }
    auto request = std::make_shared<AddTwoInts::Request>();
    request->a = 2;
    request->b = 3;
    is_waiting_ = true;
    client_->async_send_request(request, [this](rclcpp::Client<AddTwoInts>::SharedFuture future) {
      is_waiting_ = false;
      RCLCPP_INFO(get_logger(), "Result of add_two_ints: %" PRId64, future.get()->sum);
    });
  }

  rclcpp::Client<AddTwoInts>::SharedPtr client_;
  IntrospectionParameter introspection_;
  rclcpp::TimerBase::SharedPtr timer_;
  bool is_waiting_ = false;
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::IntrospectionClientNode)
