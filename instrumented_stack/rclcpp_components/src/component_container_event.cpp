// SPDX-License-Identifier: Apache-2.0
// A process for components, which share one thread that is told of what comes instead of asking for it.
#include "container_main.hpp"
#include "rclcpp/experimental/executors/events_executor/events_executor.hpp"
#include "rclcpp_components/component_manager.hpp"

int main(int argc, char** argv) {
  return rclcpp_components::container_main(
      "component_container_event", argc, argv, [](const std::vector<std::string>&) {
        const auto executor = std::make_shared<rclcpp::experimental::executors::EventsExecutor>();
        const auto manager = std::make_shared<rclcpp_components::ComponentManager>(executor);
        executor->add_node(manager);
        executor->spin();
      });
}
