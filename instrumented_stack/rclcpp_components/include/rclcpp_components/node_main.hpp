// SPDX-License-Identifier: Apache-2.0
// The program of one component, created by rclcpp_components_register_node(EXECUTABLE).
#pragma once

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/component_library.hpp"

namespace rclcpp_components {

// Spins an instance of a component that is linked into the program. Prints an exception as one line on stderr. Returns
// the exit code of the program.
template <typename ExecutorT>
int node_main(const char* class_name, int argc, char** argv) {
  try {
    const auto arguments = rclcpp::init_and_remove_ros_arguments(argc, argv);
    const std::shared_ptr<NodeFactory> factory = create_component_factory(class_name);
    if (!factory) {
      std::fprintf(stderr, "no library of this program has component '%s'\n", class_name);
      return EXIT_FAILURE;
    }
    const NodeInstanceWrapper component = factory->create_node_instance(rclcpp::NodeOptions().arguments(arguments));
    if (rclcpp::ok()) {  // a component may do all of its work in its constructor, and shut down there
      ExecutorT executor;
      executor.add_node(component.get_node_base_interface());
      executor.spin();
    }
    rclcpp::shutdown();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    const std::string program = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : class_name;
    std::fprintf(stderr, "%s: %s\n", program.c_str(), error.what());
    return EXIT_FAILURE;
  }
}

}  // namespace rclcpp_components
