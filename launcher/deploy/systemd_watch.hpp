// SPDX-License-Identifier: Apache-2.0
// What a service of systemd says of the health of its process: Type=notify and its watchdog (sd_notify(3)).
#pragma once

#include <string>
#include <vector>

#include "launcher/deploy/deployment.hpp"

namespace launch {

struct SystemdWatch {
  bool notifies = false;  // Type=notify
  bool restarts = false;  // without a respawn: by its watchdog alone
  bool ends_all = false;  // a failure of the watchdog, or of the start, ends all
  std::string settings;   // of the section [Service]
  std::vector<LeftOut> left_out;
};

// `is_awaited`: somebody waits until it has ended, and so its start is its end.
SystemdWatch systemd_watch_of(const Service& service, bool is_awaited);

}  // namespace launch
