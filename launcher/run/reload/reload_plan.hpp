// SPDX-License-Identifier: Apache-2.0
// The difference between what runs and what another reading of the launch file asks for.
#pragma once

#include <string>
#include <vector>

#include "launcher/process/process_supervisor.hpp"
#include "launcher/run/start/processes.hpp"
#include "launcher/visit/declared_process.hpp"

namespace launch {

// A process of an earlier reading.
struct KnownProcess {
  DeclaredProcess declared;
  TrackedProcess* process;
};

// What becomes of a process of the new reading.
enum class Fate {
  kStays,      // nothing has changed
  kTakesOver,  // what has changed needs no start now
  kSets,       // the values of parameters are set in its node
  kRestarts,
  kStarts  // it is new, or has not begun to run
};

struct PlannedProcess {
  Fate fate = Fate::kStarts;
  TrackedProcess* process = nullptr;         // of the earlier reading; null: it is new
  std::string label{};                       // "talker-1"; without its number if it has not started
  std::vector<std::string> changes{};        // "command line: rate:=10 -> rate:=20"
  bool needs_new_spec = false;               // at its next start
  std::vector<NamedParameter> parameters{};  // to be set
};

struct ReloadPlan {
  std::vector<DeclaredProcess> declared;
  std::vector<PlannedProcess> processes;  // as declared
  std::vector<TrackedProcess*> gone;      // of the earlier reading
  std::vector<std::string> gone_labels;
};

struct ReloadView {
  const Processes& processes;
  const ProcessSupervisor& supervisor;
  std::function<bool(ProcessId)> was_stopped;  // by a user
  bool may_set = false;                        // parameters of nodes that run
};

ReloadPlan plan_reload(const std::vector<KnownProcess>& before, const Requests& requests, const ReloadView& view);

}  // namespace launch
