// SPDX-License-Identifier: Apache-2.0
// What others have found out of a process: its health, and what it says of itself.
#include <string>
#include <utility>

#include "launcher/process/process_supervisor.hpp"
#include "launcher/process/supervised_process.hpp"

namespace launch {

void Supervision::restart_unhealthy(Supervised& process) {
  if (!shutting_down) {
    process.request = Request::kRestartUnhealthy;
    interrupt(process);
  }
}

void Supervision::set_health(Supervised& process, HealthChanged change) {
  change.pid = process.process.pid;
  process.health = change.health;
  process.health_reason = change.reason;
  notify(process, std::move(change));
}

void ProcessSupervisor::restart_unhealthy(ProcessId id) {
  impl_->handle(*impl_->processes.at(id - 1), SupervisionEvent::kUnhealthy);
}

void ProcessSupervisor::set_status(ProcessId id, const std::string& text) {
  impl_->processes.at(id - 1)->status = text;
}

void ProcessSupervisor::set_health(ProcessId id, HealthChanged change) {
  impl_->set_health(*impl_->processes.at(id - 1), std::move(change));
}

}  // namespace launch
