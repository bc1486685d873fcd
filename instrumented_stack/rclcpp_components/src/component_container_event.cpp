// SPDX-License-Identifier: Apache-2.0
// A process for components that share one thread with an events executor: it is notified of arrivals instead of
// polling.
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
