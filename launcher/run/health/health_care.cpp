// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/health/health_care.hpp"

#include <fmt/format.h>

#include <utility>
#include <variant>

namespace launch {

HealthCare::HealthCare(EventLoop& loop, ProcessSupervisor& supervisor, CrashCollector& crashes, Callbacks callbacks)
    : monitor(loop, supervisor,
              {[this](ProcessId id, const HealthWatch& watch, const std::string& reason) {
                 on_unhealthy(id, watch, reason);
               },
               callbacks.tell}),
      supervisor_(supervisor),
      crashes_(crashes),
      callbacks_(std::move(callbacks)) {}

void HealthCare::on_event(const ProcessEvent& event) {
  monitor.on_event(event);
  const auto* const reached = std::get_if<StartLimitReached>(&event.what);
  if (reached != nullptr && event.spec.start_limit.shuts_down) {
    callbacks_.tell(
        LogLevel::kError, "launch",
        fmt::format("process[{}] has reached its limit of starts: shutting down launched system", event.label));
    callbacks_.shutdown(fmt::format("process[{}] has reached its limit of starts", event.label));
  }
}

void HealthCare::on_unhealthy(ProcessId id, const HealthWatch& watch, const std::string& reason) {
  const ProcessView view = supervisor_.view(id);
  crashes_.on_unhealthy(id, reason, [this, id, watch, pid = view.pid] {
    // The run may have ended meanwhile.
    if (supervisor_.view(id).pid == pid) {
      react(id, watch);
    }
  });
}

void HealthCare::react(ProcessId id, const HealthWatch& watch) {
  const std::string label = supervisor_.view(id).label;
  switch (watch.reaction) {
    case OnUnhealthy::kNothing:
      return;
    case OnUnhealthy::kRestart:
      callbacks_.tell(LogLevel::kInfo, label, "restarting the process, because it is unhealthy");
      supervisor_.restart_unhealthy(id);
      return;
    case OnUnhealthy::kSignal:
      supervisor_.signal(id, watch.signal);
      return;
    case OnUnhealthy::kShutdown:
      callbacks_.tell(LogLevel::kError, "launch",
                      fmt::format("process[{}] is unhealthy: shutting down launched system", label));
      callbacks_.shutdown(fmt::format("process[{}] is unhealthy", label));
      return;
  }
}

}  // namespace launch
