// SPDX-License-Identifier: Apache-2.0
// The autonomous driving system of graph.hpp, or some of its nodes, in one process:
//
//   reference_system [--number-crunch-limit N] [--intra-process] [--messages N] [--list] [NODE…]
//
// Without a NODE it runs all of them. It ends when it is interrupted, or when each node at the end of the graph has
// received N messages that passed all nodes before it. These nodes then report how long messages took from each earlier
// node.
//
// The executables of autoware_reference_system are also this program. Each uses the executor in its name.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "nodes.hpp"

#ifndef REFERENCE_SYSTEM_EXECUTOR
#define REFERENCE_SYSTEM_EXECUTOR SingleThreadedExecutor
#endif

namespace {

using namespace reference_system;

struct Arguments {
  Settings settings;
  bool list = false;
  std::vector<NodeDescription> nodes;
};

uint64_t parse_number(const std::string& option, const std::string& value) {
  size_t end = 0;
  uint64_t number = 0;
  try {
    number = std::stoull(value, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  if (end == 0 || end != value.size() || value.front() == '-') {
    throw std::invalid_argument("option " + option + ": '" + value + "' is no number");
  }
  return number;
}

Arguments parse(const std::vector<std::string>& argv) {
  Arguments arguments;
  for (size_t i = 1; i < argv.size(); ++i) {
    if (argv[i] == "--intra-process") {
      arguments.settings.use_intra_process_comms = true;
    } else if (argv[i] == "--list") {
      arguments.list = true;
    } else if (argv[i] == "--number-crunch-limit" || argv[i] == "--messages") {
      if (i + 1 == argv.size()) {
        throw std::invalid_argument("option " + argv[i] + " needs a number");
      }
      Settings& settings = arguments.settings;
      (argv[i] == "--messages" ? settings.messages : settings.number_crunch_limit) = parse_number(argv[i], argv[i + 1]);
      ++i;
    } else if (argv[i].front() == '-') {
      throw std::invalid_argument("unknown option '" + argv[i] +
                                  "': there are --number-crunch-limit, --intra-process, --messages and --list");
    } else {
      arguments.nodes.push_back(find(argv[i]));
    }
  }
  if (arguments.nodes.empty()) {
    arguments.nodes = graph();
  }
  return arguments;
}

void list(const std::vector<NodeDescription>& nodes) {
  for (const NodeDescription& node : nodes) {
    std::printf("%s\n", node.name.c_str());
    for (const std::string& input : node.inputs) {
      std::printf("  %s\n", input.c_str());
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Arguments arguments = parse(rclcpp::init_and_remove_ros_arguments(argc, argv));
    if (arguments.list) {
      list(arguments.nodes);
      return EXIT_SUCCESS;
    }
    std::vector<std::shared_ptr<rclcpp::Node>> nodes;
    rclcpp::executors::REFERENCE_SYSTEM_EXECUTOR executor;
    for (const NodeDescription& description : arguments.nodes) {
      nodes.push_back(create_node(description, arguments.settings));
      executor.add_node(nodes.back());
    }
    executor.spin();
    nodes.clear();
    rclcpp::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "reference_system: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
