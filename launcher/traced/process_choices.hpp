// SPDX-License-Identifier: Apache-2.0
// What a trace wants of the processes that it records.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracing/record/session/traced_run.hpp"

namespace launch {

// Of processes of another ROS 2. kAuto: ours where every call means the same, else theirs. kOwn: a process that cannot
// have ours is an error. kTheirs: nothing is preloaded.
enum class TracetoolsMode { kAuto, kOwn, kTheirs };

struct ProcessChoices : tracing::RunChoices {
  // Patterns of the nodes and processes to record; all are recorded when this is not given.
  std::optional<std::vector<std::string>> nodes = {};
  TracetoolsMode tracetools = TracetoolsMode::kAuto;
  bool python_nodes = false;  // callbacks of rclpy have events
  bool auto_buffers = false;  // userspace buffers sized from the number of processes and processors
};

}  // namespace launch
