// SPDX-License-Identifier: Apache-2.0
// A process for components that share one thread.
#include "container_main.hpp"
#include "rclcpp_components/component_manager.hpp"

int main(int argc, char** argv) {
  return rclcpp_components::container_main("component_container", argc, argv, [](const std::vector<std::string>&) {
    const auto executor = std::make_shared<rclcpp::executors::SingleThreadedExecutor>();
    const auto manager = std::make_shared<rclcpp_components::ComponentManager>(executor);
    executor->add_node(manager);
    executor->spin();
  });
}
