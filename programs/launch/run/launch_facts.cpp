// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/run/launch_facts.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <system_error>

namespace launch {

LaunchFacts launch_facts(const CommandLine& command, const std::vector<std::string>& files, const Guardian& guardian,
                         const Isolation& isolation, const std::string& log_directory, const std::string& log) {
  std::error_code unknown;
  std::vector<std::string> paths;
  for (const std::string& file : files) {
    paths.push_back(file == "-" ? file : std::filesystem::absolute(file, unknown).string());
  }
  return {.pid = guardian.pid(),
          .command = command.words,
          .files = std::move(paths),
          .directory = std::filesystem::current_path(unknown).string(),
          .log_directory = log_directory,
          .log_file = log,
          .started = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(),
          .isolation = isolation.domain       ? fmt::format("ROS_DOMAIN_ID={}", isolation.domain->id())
                       : isolation.namespaces ? "namespaces"
                                              : ""};
}

void tell_isolation(const CommandLine& command, const Isolation& isolation, OutputRouter& output) {
  if (command.contain) {
    output.message(LogLevel::kInfo, "launch",
                   "the launch has process numbers of its own; nothing in its process namespace can survive it");
  }
  if (isolation.domain) {
    output.message(
        LogLevel::kWarning, "launch",
        fmt::format("namespaces are not allowed here ({}): the launch is isolated by ROS_DOMAIN_ID={}, which "
                    "it has leased",
                    isolation.refused, isolation.domain->id()));
  } else if (isolation.namespaces) {
    output.message(LogLevel::kInfo, "launch", "the launch has a network and a /dev/shm of its own");
  }
}

}  // namespace launch
