// SPDX-License-Identifier: Apache-2.0
// What a service manager such as systemd is told of a launch: how far it is, when everything has started, that it ends.
#pragma once

#include <string>

#include "launcher/process/output/journal.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/process/service_manager.hpp"
#include "launcher/run/launch_service.hpp"

namespace launch {

class ServiceStatus {
 public:
  // The references must outlive this object.
  ServiceStatus(const ServiceAddress& address, EventLoop& loop, LaunchService& service, ProcessSupervisor& supervisor);

  // What the status line shows: "starting 1 of 2", or "" while all processes run.
  void show(const std::string& progress);

 private:
  ProcessSupervisor& supervisor_;
  ServiceManager manager_;
  std::string progress_;
};

// For the journal: where a process comes from.
Journal::Origin origin_of(const ProcessView& process);

}  // namespace launch
