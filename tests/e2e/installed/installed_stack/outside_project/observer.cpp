// SPDX-License-Identifier: Apache-2.0
// Loads a managed node into a container, activates it and prints its first report.
#include <composition_interfaces/srv/load_node.hpp>
#include <cstdio>
#include <lifecycle_msgs/msg/transition.hpp>
#include <lifecycle_msgs/srv/change_state.hpp>

#include "rclcpp/rclcpp.hpp"
#include "weather/msg/report.hpp"

using composition_interfaces::srv::LoadNode;
using lifecycle_msgs::msg::Transition;
using lifecycle_msgs::srv::ChangeState;

template <typename ServiceT>
std::shared_ptr<typename ServiceT::Response> ask(const rclcpp::Node::SharedPtr& node, const std::string& service,
                                                 std::shared_ptr<typename ServiceT::Request> request) {
  const auto client = node->create_client<ServiceT>(service);
  client->wait_for_service();
  auto future = client->async_send_request(request);
  rclcpp::spin_until_future_complete(node, future);
  return future.get();
}

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto node = std::make_shared<rclcpp::Node>("observer");
  auto load = std::make_shared<LoadNode::Request>();
  load->package_name = "weather";
  load->plugin_name = "instruments::Thermometer";
  load->parameters = {rclcpp::Parameter("temperature", -3.5).to_parameter_msg()};
  const auto loaded = ask<LoadNode>(node, "/ComponentManager/_container/load_node", load);
  std::printf("loaded %s%s\n", loaded->full_node_name.c_str(), loaded->error_message.c_str());
  if (!loaded->success) {
    return 1;
  }
  for (const uint8_t transition : {Transition::TRANSITION_CONFIGURE, Transition::TRANSITION_ACTIVATE}) {
    auto change = std::make_shared<ChangeState::Request>();
    change->transition.id = transition;
    if (!ask<ChangeState>(node, loaded->full_node_name + "/change_state", change)->success) {
      return 1;
    }
  }
  const auto subscription = node->create_subscription<weather::msg::Report>(
      "report", rclcpp::QoS(1).transient_local(), [](const weather::msg::Report& report) {
        std::printf("%s\n", to_yaml(report, true).c_str());
        rclcpp::shutdown();
      });
  rclcpp::spin(node);
}
