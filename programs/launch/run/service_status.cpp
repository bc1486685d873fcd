// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/run/service_status.hpp"

#include <fmt/format.h>

namespace launch {

ServiceStatus::ServiceStatus(const ServiceAddress& address, EventLoop& loop, LaunchService& service,
                             ProcessSupervisor& supervisor)
    : supervisor_(supervisor), manager_(address, loop) {
  service.observe_started([this] { manager_.ready(); });
  supervisor.observe([this, &service](const ProcessEvent&) {
    if (service.steering().is_ending()) {
      manager_.stopping();
    } else if (progress_.empty()) {
      show("");
    }
  });
}

void ServiceStatus::show(const std::string& progress) {
  progress_ = progress;
  const std::size_t count = supervisor_.active();
  manager_.status(!progress.empty() ? progress
                                    : fmt::format("{} {}", count, count == 1 ? "process runs" : "processes run"));
}

Journal::Origin origin_of(const ProcessView& process) {
  const SourceRange& where = process.spec.origin;
  Journal::Origin origin{.process = process.label,
                         .node = process.spec.other_names.empty() ? "" : process.spec.other_names.front()};
  if (where) {
    origin.file = where.file->path();
    origin.line_number = static_cast<unsigned>(where.file->position(where.begin).line);
  }
  return origin;
}

}  // namespace launch
