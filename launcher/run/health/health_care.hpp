// SPDX-License-Identifier: Apache-2.0
// What a launch does for the health of its processes: it watches them, and lets follow what their watches ask for.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

#include "launcher/crash/crash_collector.hpp"
#include "launcher/health/health_monitor.hpp"

namespace launch {

class HealthCare {
 public:
  struct Callbacks {
    std::function<void(LogLevel level, const std::string& logger, const std::string& text)> tell;
    std::function<void(const std::string& reason)> shutdown;
  };

  // The references must outlive this object.
  HealthCare(EventLoop& loop, ProcessSupervisor& supervisor, CrashCollector& crashes, Callbacks callbacks);

  // What an unhealthy process leaves behind is collected first, then it is restarted, signalled, or ends the launch.
  HealthMonitor monitor;

  // Ends the launch when a process is given up whose limit of starts says so.
  void on_event(const ProcessEvent& event);

 private:
  void on_unhealthy(ProcessId id, const HealthWatch& watch, const std::string& reason);
  void react(ProcessId id, const HealthWatch& watch);

  ProcessSupervisor& supervisor_;
  CrashCollector& crashes_;
  Callbacks callbacks_;
};

}  // namespace launch
