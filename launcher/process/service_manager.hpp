// SPDX-License-Identifier: Apache-2.0
// The service manager that has started the launch, such as systemd with Type=notify: what sd_notify(3) and
// sd_watchdog_enabled(3) describe.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "base/environment/environment.hpp"
#include "base/files/unique_fd.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

// Where news go. Its variables are taken out of the environment: they are for the launch, not for its processes.
struct ServiceAddress {
  // Nothing if no service manager wants news. Also takes the variables out of the environment of this process, so there
  // must be one thread.
  static std::optional<ServiceAddress> take(Environment& environment);

  std::string socket;                     // a path, or an abstract name behind "@"
  std::chrono::microseconds watchdog{0};  // 0: none
};

class ServiceManager {
 public:
  // The loop, which must outlive this object, tells of itself in time for the watchdog. If it is blocked, it does not.
  ServiceManager(const ServiceAddress& address, EventLoop& loop);

  void ready();
  void stopping();
  void status(std::string_view text);

 private:
  void send(std::string_view news) const;
  void feed_watchdog();

  std::string socket_;
  EventLoop& loop_;
  std::chrono::microseconds watchdog_;
  UniqueFd fd_;
  EventLoop::SourcePtr timer_;
};

}  // namespace launch
