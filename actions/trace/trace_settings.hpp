// SPDX-License-Identifier: Apache-2.0
// The settings of <trace> and of its <channel>: a row for each attribute. `launch trace` has some of them as options.
#pragma once

#include <vector>

#include "launcher/language/setting.hpp"
#include "launcher/traced/process_choices.hpp"
#include "launcher/visit/run_scope.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace launch {

// The attributes of <trace> that concern the launcher rather than the tracer.
struct TraceChoices : ProcessChoices {
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
