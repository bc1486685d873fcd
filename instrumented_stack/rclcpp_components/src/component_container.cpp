// SPDX-License-Identifier: Apache-2.0
// The programs that are processes for components. CMakeLists.txt defines CONTAINER, the name of the program:
//
//   component_container             components share one thread
//   component_container_mt          components share several threads
//   component_container_event       components share one thread with an events executor: it is notified of arrivals
//                                   instead of polling
//   component_container_events_cbg  components share several threads, which are notified of arrivals
//   component_container_isolated    each component has its own executor and thread
//
// Each of them takes the options of container_options.hpp, and the parameter thread_num.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "container_options.hpp"
#include "rclcpp/experimental/executors/events_executor/events_executor.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/component_manager_isolated.hpp"

namespace {

using rclcpp::executors::EventsCBGExecutor;
using rclcpp::executors::MultiThreadedExecutor;
using rclcpp::executors::SingleThreadedExecutor;
using rclcpp::experimental::executors::EventsExecutor;
using rclcpp_components::ComponentManager;
using rclcpp_components::ComponentManagerIsolated;
using rclcpp_components::ContainerOptions;
using rclcpp_components::ExecutorType;

constexpr const char* kThreads = "thread_num";

std::shared_ptr<ComponentManager> make_manager(const ContainerOptions& options) {
  if (!options.is_isolated) {
    return std::make_shared<ComponentManager>();
  }
  switch (options.executor) {
    case ExecutorType::kMultiThreaded:
      return std::make_shared<ComponentManagerIsolated<MultiThreadedExecutor>>();
    case ExecutorType::kEvents:
      return std::make_shared<ComponentManagerIsolated<EventsExecutor>>();
    case ExecutorType::kEventsCbg:
      return std::make_shared<ComponentManagerIsolated<EventsCBGExecutor>>();
    case ExecutorType::kSingleThreaded:
      break;
  }
  return std::make_shared<ComponentManagerIsolated<SingleThreadedExecutor>>();
}

std::shared_ptr<rclcpp::Executor> make_executor(ExecutorType type, std::size_t threads) {
  switch (type) {
    case ExecutorType::kMultiThreaded:
      return std::make_shared<MultiThreadedExecutor>(rclcpp::ExecutorOptions(), threads);
    case ExecutorType::kEvents:
      return std::make_shared<EventsExecutor>();
    case ExecutorType::kEventsCbg:
      return std::make_shared<EventsCBGExecutor>(rclcpp::ExecutorOptions(), threads);
    case ExecutorType::kSingleThreaded:
      break;
  }
  return std::make_shared<SingleThreadedExecutor>();
}

void run_container(const ContainerOptions& options) {
  const std::shared_ptr<ComponentManager> manager = make_manager(options);
  const bool has_one_thread =
      options.executor == ExecutorType::kSingleThreaded || options.executor == ExecutorType::kEvents;
  if (has_one_thread && manager->get_node_parameters_interface()->get_parameter_overrides().count(kThreads) != 0) {
    RCLCPP_WARN(manager->get_logger(),
                "The parameter '%s' has no effect: the executor has one thread (--executor-type multi-threaded or "
                "events-cbg has several)",
                kThreads);
  }
  // The executor of an isolated container only executes the services of the container.
  const auto threads = static_cast<std::size_t>(manager->get_parameter(kThreads).as_int());
  const auto executor = make_executor(options.is_isolated ? ExecutorType::kSingleThreaded : options.executor, threads);
  manager->set_executor(executor);
  executor->add_node(manager);
  executor->spin();
}

}  // namespace

// Prints an exception, also of a component, as one line on stderr.
int main(int argc, char** argv) {
  try {
    const ContainerOptions options =
        rclcpp_components::parse_container_options(CONTAINER, rclcpp::init_and_remove_ros_arguments(argc, argv));
    if (options.wants_help) {
      std::fputs(rclcpp_components::container_usage(CONTAINER).c_str(), stdout);
    } else {
      run_container(options);
    }
    rclcpp::shutdown();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", CONTAINER, error.what());
    return EXIT_FAILURE;
  }
}
