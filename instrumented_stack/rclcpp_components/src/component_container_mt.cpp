// SPDX-License-Identifier: Apache-2.0
// A process for components that share several threads.
//
// Parameter: thread_num  number of threads (default: one per processor)
#include "container_main.hpp"
#include "rclcpp_components/component_manager.hpp"

int main(int argc, char** argv) {
  return rclcpp_components::container_main("component_container_mt", argc, argv, [](const std::vector<std::string>&) {
    const auto manager = std::make_shared<rclcpp_components::ComponentManager>();
    const auto threads = static_cast<size_t>(manager->get_parameter("thread_num").as_int());
    const auto executor =
        std::make_shared<rclcpp::executors::MultiThreadedExecutor>(rclcpp::ExecutorOptions(), threads);
    manager->set_executor(executor);
    executor->add_node(manager);
    executor->spin();
  });
}
