// SPDX-License-Identifier: Apache-2.0
#include "launcher/deploy/systemd_watch.hpp"

#include <fmt/format.h>

#include <variant>

namespace launch {

SystemdWatch systemd_watch_of(const Service& service, bool is_awaited) {
  SystemdWatch result;
  const auto leave_out = [&](const std::string& what, const HealthWatch& watch) {
    result.left_out.push_back({what, watch.where ? watch.where : service.spec->origin});
  };
  for (const HealthWatch& watch : service.spec->watches) {
    const auto* const notifies = std::get_if<Notifies>(&watch.subject);
    const bool reacts = watch.reaction == OnUnhealthy::kRestart || watch.reaction == OnUnhealthy::kShutdown;
    if (notifies == nullptr || is_awaited || result.notifies) {
      leave_out(fmt::format("'{}' is healthy while {}", service.name, describe(watch)), watch);
      continue;
    }
    result.notifies = true;
    result.settings = "NotifyAccess=all\n";
    // Without a reaction the service would fail where the process only gets unhealthy.
    const bool fails_late = watch.reaction == OnUnhealthy::kShutdown ||
                            (watch.reaction == OnUnhealthy::kRestart && service.spec->respawn.enabled);
    result.settings +=
        fmt::format("TimeoutStartSec={}\n", fails_late ? seconds_text(watch.timeout + watch.start_period) : "infinity");
    if (!fails_late) {
      leave_out(fmt::format("'{}' gets unhealthy if it is not ready in time", service.name), watch);
    }
    if (!notifies->watchdog) {
      continue;
    }
    if (!reacts) {
      leave_out(fmt::format("the watchdog of '{}', on which no restart and no end of all follows", service.name),
                watch);
      continue;
    }
    // As the launcher would end it.
    result.settings += fmt::format("WatchdogSec={}\nWatchdogSignal=SIGINT\nTimeoutAbortSec={}\n",
                                   seconds_text(watch.timeout), seconds_text(stop_timeout_of(*service.spec)));
    result.restarts = watch.reaction == OnUnhealthy::kRestart;
    result.ends_all = watch.reaction == OnUnhealthy::kShutdown;
  }
  return result;
}

}  // namespace launch
