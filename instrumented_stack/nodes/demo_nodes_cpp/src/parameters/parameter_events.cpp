// SPDX-License-Identifier: Apache-2.0
// Does the same as parameter_events_async, with a client that waits for each answer.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "own_parameters.hpp"

namespace {

using demo_nodes_cpp::to_text;
using rcl_interfaces::msg::ParameterEvent;

void run(const rclcpp::Node::SharedPtr& node) {
  rclcpp::SyncParametersClient client(node);
  if (!demo_nodes_cpp::wait_for_service(client, node->get_logger())) {
    return;
  }
  bool heard_of_all = false;
  const auto subscription = client.on_parameter_event([&](const ParameterEvent& event) {
    if (event.node != node->get_fully_qualified_name()) {
      return;
    }
    RCLCPP_INFO(node->get_logger(), "%s", to_text(event).c_str());
    for (const auto& parameter : event.changed_parameters) {
      heard_of_all = heard_of_all || (parameter.name == "bar" && parameter.value.string_value == "world");
    }
  });
  node->declare_parameter("foo", 0);
  node->declare_parameter("bar", "");
  node->declare_parameter("baz", 0.);
  node->declare_parameter("foobar", false);
  client.set_parameters({rclcpp::Parameter("foo", 2), rclcpp::Parameter("bar", "hello"), rclcpp::Parameter("baz", 1.45),
                         rclcpp::Parameter("foobar", true)});
  client.set_parameters({rclcpp::Parameter("foo", 3), rclcpp::Parameter("bar", "world")});
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  while (rclcpp::ok() && !heard_of_all) {
    executor.spin_once();
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    rclcpp::init(argc, argv);
    run(std::make_shared<rclcpp::Node>("parameter_events"));
    rclcpp::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "parameter_events: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
