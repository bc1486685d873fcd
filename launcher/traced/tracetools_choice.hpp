// SPDX-License-Identifier: Apache-2.0
// Which tracetools the processes of a <trace> get: our own in nodes of another ROS 2 where that is possible.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "launcher/process/process_spec.hpp"
#include "launcher/traced/process_choices.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/programs/tracetools_check.hpp"

namespace launch {

class TracetoolsChoice {
 public:
  // `prefix`: of this installation.
  TracetoolsChoice(TracetoolsMode mode, std::string prefix) : mode_(mode), check_(std::move(prefix)) {}

  // Looks at the program of the process. Returns what is known of it; theirs if nothing may be preloaded.
  const tracing::TracetoolsFinding& look_at(const ProcessSpec& spec);
  // Adds to the environment of the process what a library that stands in needs.
  static void preload(const tracing::TracetoolsFinding& finding, Environment& environment);

  // A sentence on processes that keep theirs, of those that look_at() has met since the last call: which settings of
  // the trace have no effect on them, and why. "" if there are none.
  std::string ineffective(const tracing::TraceConfig& config, const std::vector<std::string>& settings);
  // The first process that keeps theirs and must not, with the reason, as a sentence.
  std::optional<std::string> refused() const;
  // All processes with a tracetools of another ROS 2, for the verdict.
  std::vector<tracing::TracetoolsUse> uses() const;

 private:
  TracetoolsMode mode_;
  tracing::TracetoolsCheck check_;
  std::map<std::string, tracing::TracetoolsFinding> of_process_;  // by its label
  std::vector<std::string> in_order_;                             // the labels
  std::size_t told_ = 0;                                          // so many of them
};

}  // namespace launch
