// SPDX-License-Identifier: Apache-2.0
// twin_node FILE PROCESS: the stand-in of a process of the twin that the file describes.
#include <cstdio>
#include <exception>
#include <rclcpp/rclcpp.hpp>
#include <stdexcept>
#include <string>

#include "programs/twin_node/twin_process.hpp"
#include "tracing/model/twin/description/description_file.hpp"

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> words = rclcpp::init_and_remove_ros_arguments(argc, argv);
    if (words.size() != 3) {
      throw std::runtime_error("needs two arguments: the description of a twin, and the number of a process");
    }
    const tracing::twin::System system = tracing::twin::read_description(words[1]);
    std::size_t end = 0;
    const std::size_t process = std::stoul(words[2], &end);
    if (end != words[2].size() || process >= system.processes.size()) {
      throw std::runtime_error("the twin has no process '" + words[2] + "'");
    }
    twin_node::TwinProcess(system, process).spin();
    rclcpp::shutdown();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "twin_node: error: %s\n", error.what());
    return 1;
  }
}
