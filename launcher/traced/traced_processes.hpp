// SPDX-License-Identifier: Apache-2.0
// Chooses the processes that a trace records, and prepares their environment. On the machine where they run.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "launcher/process/process_spec.hpp"
#include "launcher/traced/process_choices.hpp"
#include "launcher/traced/tracetools_choice.hpp"
#include "tracing/record/session/traced_run.hpp"

namespace launch {

// A sentence for each pattern of `nodes` that none of the processes fits.
std::vector<std::string> unknown_nodes(const ProcessChoices& choices, const std::vector<ProcessSpec>& processes);

class TracedProcesses {
 public:
  // The run must outlive this.
  TracedProcesses(tracing::TracedRun& run, ProcessChoices choices);

  // The processes that will start once the session has begun: sizes buffers, and warns through the run. Call it before
  // the session begins. `all`: there are no others on other machines.
  void expect(const std::vector<ProcessSpec>& processes, bool all);
  // Changes the spec of a process that is about to start. `warn` gets a sentence; it may be empty.
  void prepare(ProcessSpec& spec, const std::function<void(const std::string&)>& warn);

  // Why the session must not begin, as of TracetoolsChoice.
  std::optional<std::string> refused() const { return tracetools_.refused(); }
  std::vector<tracing::TracetoolsUse> uses() const { return tracetools_.uses(); }

 private:
  bool traces(const ProcessSpec& spec) const;
  bool records_programs() const { return !run_.config().all_events_ust().empty(); }
  // The settings that only our tracetools carries out.
  std::vector<std::string> settings_of_tracetools() const;

  tracing::TracedRun& run_;
  ProcessChoices choices_;
  TracetoolsChoice tracetools_;
};

}  // namespace launch
