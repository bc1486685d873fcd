// SPDX-License-Identifier: Apache-2.0
// The four programs that are processes for components. CMakeLists.txt defines CONTAINER, the name of the program:
//
//   component_container           components share one thread
//   component_container_mt        components share several threads
//                                   parameter thread_num: number of threads (default: one per processor)
//   component_container_event     components share one thread with an events executor: it is notified of arrivals
//                                   instead of polling
//   component_container_isolated  each component has its own executor and thread
//                                   option --use_multi_threaded_executor: each has several threads
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rclcpp/experimental/executors/events_executor/events_executor.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/component_manager_isolated.hpp"

namespace {

using rclcpp::executors::MultiThreadedExecutor;
using rclcpp::executors::SingleThreadedExecutor;
using rclcpp_components::ComponentManager;
using rclcpp_components::ComponentManagerIsolated;

template <typename ExecutorT, typename ManagerT>
void run() {
  const auto executor = std::make_shared<ExecutorT>();
  const auto manager = std::make_shared<ManagerT>(executor);
  executor->add_node(manager);
  executor->spin();
}

void run_in_threads() {
  const auto manager = std::make_shared<ComponentManager>();
  const auto threads = static_cast<size_t>(manager->get_parameter("thread_num").as_int());
  const auto executor = std::make_shared<MultiThreadedExecutor>(rclcpp::ExecutorOptions(), threads);
  manager->set_executor(executor);
  executor->add_node(manager);
  executor->spin();
}

// With the arguments that are not for ROS, starting with the program's name.
void run_container(std::string_view container, const std::vector<std::string>& arguments) {
  if (container == "component_container_mt") {
    run_in_threads();
  } else if (container == "component_container_event") {
    run<rclcpp::experimental::executors::EventsExecutor, ComponentManager>();
  } else if (container != "component_container_isolated") {
    run<SingleThreadedExecutor, ComponentManager>();
  } else if (std::find(arguments.begin(), arguments.end(), "--use_multi_threaded_executor") == arguments.end()) {
    run<SingleThreadedExecutor, ComponentManagerIsolated<SingleThreadedExecutor>>();
  } else {
    run<SingleThreadedExecutor, ComponentManagerIsolated<MultiThreadedExecutor>>();
  }
}

}  // namespace

// Prints an exception, also of a component, as one line on stderr.
int main(int argc, char** argv) {
  try {
    run_container(CONTAINER, rclcpp::init_and_remove_ros_arguments(argc, argv));
    rclcpp::shutdown();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", CONTAINER, error.what());
    return EXIT_FAILURE;
  }
}
