// SPDX-License-Identifier: Apache-2.0
// Changes its own parameters twice, gets the events as every node does, and ends.
#include "own_parameters.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace demo_nodes_cpp {

class ParameterEventsAsyncNode : public rclcpp::Node {
 public:
  explicit ParameterEventsAsyncNode(const rclcpp::NodeOptions& options) : Node("parameter_events", options) {
    client_ = std::make_shared<rclcpp::AsyncParametersClient>(this);
    events_ = client_->on_parameter_event([this](const rcl_interfaces::msg::ParameterEvent& event) { hear(event); });
    declare_parameter("foo", 0);
    declare_parameter("bar", "");
    declare_parameter("baz", 0.);
    declare_parameter("foobar", false);
    timer_ = create_wall_timer(std::chrono::milliseconds(200), [this] {
      if (client_->service_is_ready()) {
        timer_->cancel();
        change();
      }
    });
  }

 private:
  using Results = std::shared_future<std::vector<rcl_interfaces::msg::SetParametersResult>>;

  void change() {
    const auto change_again = [this](Results results) {
      report_failures(results.get(), get_logger());
      client_->set_parameters({rclcpp::Parameter("foo", 3), rclcpp::Parameter("bar", "world")},
                              [this](Results last) { report_failures(last.get(), get_logger()); });
    };
    client_->set_parameters({rclcpp::Parameter("foo", 2), rclcpp::Parameter("bar", "hello"),
                             rclcpp::Parameter("baz", 1.45), rclcpp::Parameter("foobar", true)},
                            change_again);
  }

  void hear(const rcl_interfaces::msg::ParameterEvent& event) {
    if (event.node != get_fully_qualified_name()) {
      return;
    }
    RCLCPP_INFO(get_logger(), "%s", to_text(event).c_str());
    for (const auto& parameter : event.changed_parameters) {
      if (parameter.name == "bar" && parameter.value.string_value == "world") {
        rclcpp::shutdown();
      }
    }
  }

  rclcpp::AsyncParametersClient::SharedPtr client_;
  rclcpp::Subscription<rcl_interfaces::msg::ParameterEvent>::SharedPtr events_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::ParameterEventsAsyncNode)
