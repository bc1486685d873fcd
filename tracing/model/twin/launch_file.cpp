// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/launch_file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tracing::twin {

namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '-':
        // Two of them may not stand in a comment.
        result += result.ends_with('-') ? " -" : "-";
        break;
      default:
        result += static_cast<unsigned char>(c) < ' ' ? '?' : c;
    }
  }
  return result;
}

std::string nodes_of(const System& system, Index process) {
  std::string names;
  for (const Node& node : system.nodes) {
    if (node.process == process) {
      names += (names.empty() ? "" : ", ") + node.name;
    }
  }
  return names;
}

int priority_of(const System& system, Index process) {
  int priority = 0;
  for (const Executor& executor : system.executors) {
    if (executor.process == process) {
      priority = std::max(priority, executor.priority);
    }
  }
  return priority;
}

}  // namespace

std::string launch_file_of(const System& system, const LaunchFileOptions& options) {
  std::string text = "<launch>\n";
  text += fmt::format("  <arg name=\"duration\" default=\"{:.1f}\" description=\"seconds until the end\"/>\n",
                      std::max(1.0, static_cast<double>(system.duration_ns) / 1e9));
  text +=
      "  <arg name=\"traces\" default=\"$(dirname)\" description=\"where the directory of the trace is made\"/>\n\n";
  text += fmt::format(
      "  <trace session-name=\"twin\" append-timestamp=\"true\" base-path=\"$(var traces)\"\n"
      "         subbuffer-size-ust=\"1048576\" events-ust=\"ros2:*{}\"/>\n\n",
      options.ext_events ? " ros2_ext:*" : "");
  for (Index process = 0; process < system.processes.size(); ++process) {
    text +=
        fmt::format("  <!-- {}: {} -->\n", escaped(system.processes[process].name), escaped(nodes_of(system, process)));
    text += fmt::format("  <node pkg=\"launch_twin\" exec=\"twin_node\" args=\"$(dirname)/{} {}\"", options.description,
                        process);
    if (options.cpus > 0) {
      text += options.cpus == 1 ? " cpus=\"0\"" : fmt::format(" cpus=\"0-{}\"", options.cpus - 1);
    }
    if (const int priority = priority_of(system, process); priority > 0) {
      text += fmt::format(" sched_policy=\"fifo\" sched_priority=\"{}\"", priority);
    }
    text += "/>\n";
  }
  text +=
      "\n  <timer period=\"$(var duration)\">\n"
      "    <shutdown reason=\"the twin has run as long as the system that was recorded\"/>\n"
      "  </timer>\n"
      "</launch>\n";
  return text;
}

}  // namespace tracing::twin
