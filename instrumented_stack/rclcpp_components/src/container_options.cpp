// SPDX-License-Identifier: Apache-2.0
#include "container_options.hpp"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "nearest_name.hpp"

namespace rclcpp_components {

namespace {

constexpr std::array<std::pair<std::string_view, ExecutorType>, 4> kExecutors = {
    {{"single-threaded", ExecutorType::kSingleThreaded},
     {"multi-threaded", ExecutorType::kMultiThreaded},
     {"events", ExecutorType::kEvents},
     {"events-cbg", ExecutorType::kEventsCbg}}};
constexpr std::array<std::string_view, 4> kOptions = {"--executor-type", "--isolated", "--use_multi_threaded_executor",
                                                      "--help"};

std::string executor_names() {
  std::string names;
  for (const auto& [name, type] : kExecutors) {
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  return names;
}

ExecutorType executor_of(std::string_view wanted) {
  std::vector<std::string_view> names;
  for (const auto& [name, type] : kExecutors) {
    if (name == wanted) {
      return type;
    }
    names.push_back(name);
  }
  throw std::invalid_argument("unknown executor '" + std::string(wanted) + "' in --executor-type" +
                              did_you_mean(wanted, names) + " (one of " + executor_names() + ")");
}

}  // namespace

ContainerOptions parse_container_options(std::string_view container, const std::vector<std::string>& arguments) {
  ContainerOptions options;
  if (container == "component_container_mt") {
    options.executor = ExecutorType::kMultiThreaded;
  } else if (container == "component_container_event") {
    options.executor = ExecutorType::kEvents;
  } else if (container == "component_container_events_cbg") {
    options.executor = ExecutorType::kEventsCbg;
  }
  options.is_isolated = container == "component_container_isolated";

  for (std::size_t i = 1; i < arguments.size(); ++i) {
    const std::string_view argument = arguments[i];
    constexpr std::string_view kExecutorIs = "--executor-type=";
    if (argument == "--isolated") {
      options.is_isolated = true;
    } else if (argument == "--use_multi_threaded_executor") {
      options.executor = ExecutorType::kMultiThreaded;
    } else if (argument == "--help" || argument == "-h") {
      options.wants_help = true;
    } else if (argument.substr(0, kExecutorIs.size()) == kExecutorIs) {
      options.executor = executor_of(argument.substr(kExecutorIs.size()));
    } else if (argument == "--executor-type") {
      if (i + 1 == arguments.size()) {
        throw std::invalid_argument("--executor-type needs a value (one of " + executor_names() + ")");
      }
      options.executor = executor_of(arguments[++i]);
    } else {
      const std::string known = did_you_mean(argument.substr(0, argument.find('=')), kOptions);
      throw std::invalid_argument("unknown argument '" + std::string(argument) + "'" +
                                  (known.empty() ? "; --help lists the options" : known));
    }
  }
  return options;
}

std::string container_usage(std::string_view container) {
  return "usage: " + std::string(container) +
         " [--executor-type TYPE] [--isolated] [--ros-args -p thread_num:=N …]\n"
         "\n"
         "A process for components, which are loaded by its service ~/_container/load_node.\n"
         "\n"
         "  --executor-type TYPE           what executes the components: one of\n"
         "                                 " +
         executor_names() +
         "\n"
         "  --isolated                     each component has an executor and a thread of its own\n"
         "  --use_multi_threaded_executor  the same as --executor-type multi-threaded\n"
         "  -p thread_num:=N               threads of a multi-threaded or events-cbg executor; default: one per "
         "processor\n";
}

}  // namespace rclcpp_components
