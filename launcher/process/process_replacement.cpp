// SPDX-License-Identifier: Apache-2.0
// Another spec for a process that is there already.
#include <utility>

#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/process/supervised_process.hpp"

namespace launch {

void ProcessSupervisor::adopt(ProcessId id, const ProcessSpec& spec) {
  Supervised& process = *impl_->processes.at(id - 1);
  ProcessSpec& now = process.spec;
  now.python_action = spec.python_action;
  now.other_names = spec.other_names;
  now.groups = spec.groups;
  now.scalable = spec.scalable;
  now.respawn = spec.respawn;
  now.start_limit = spec.start_limit;
  now.shutdown_on_exit = spec.shutdown_on_exit;
  now.required = spec.required;
  now.allowed_exits = spec.allowed_exits;
  now.sigterm_timeout = spec.sigterm_timeout;
  now.sigkill_timeout = spec.sigkill_timeout;
  now.origin = spec.origin;
  if (impl_->guardian != nullptr && process.unreaped) {
    impl_->guardian->note(id, process.process.pid, process.label, now);
  }
}

void ProcessSupervisor::replace(ProcessId id, ProcessSpec spec, std::function<void(ProcessSpec&)> prepare) {
  adopt(id, spec);
  impl_->processes.at(id - 1)->next = [spec = std::move(spec), prepare = std::move(prepare)]() mutable {
    prepare(spec);
    return std::move(spec);
  };
}

}  // namespace launch
