// SPDX-License-Identifier: Apache-2.0
// The settings of <trace> and of its <channel>: a row for each attribute. `launch trace` has some of them as options.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "launcher/language/setting.hpp"
#include "launcher/visit/run_scope.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/session/traced_run.hpp"

namespace launch {

// Of processes of another ROS 2. kAuto: ours where every call means the same, else theirs. kOwn: a process that cannot
// have ours is an error. kTheirs: nothing is preloaded.
enum class TracetoolsMode { kAuto, kOwn, kTheirs };

// The attributes of <trace> that concern the launcher rather than the tracer.
struct TraceChoices : tracing::RunChoices {
  // Patterns of the nodes and processes to record; all are recorded when this is not given.
  std::optional<std::vector<std::string>> nodes = {};
  TracetoolsMode tracetools = TracetoolsMode::kAuto;
  bool python_nodes = false;                // callbacks of rclpy have events
  bool auto_buffers = false;                // userspace buffers sized from the number of processes and processors
  std::vector<NamedNode> chain_nodes = {};  // those that the chains pass
};

// What a <trace> is evaluated to.
struct TraceRequest {
  tracing::TraceConfig config = {};
  TraceChoices choices = {};
};

const std::vector<Setting<TraceRequest>>& trace_settings();
const std::vector<Setting<tracing::ChannelConfig>>& channel_settings();

}  // namespace launch
