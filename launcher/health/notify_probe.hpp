// SPDX-License-Identifier: Apache-2.0
// Whether a process says by sd_notify(3) that it is ready, and that it lives.
//
// It finds the socket by NOTIFY_SOCKET, as a service of systemd does. Its children may speak for it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "base/files/unique_fd.hpp"
#include "launcher/health/health_probe.hpp"
#include "launcher/health/processor_wait.hpp"

namespace launch {

class NotifyProbe final : public HealthProbe {
 public:
  struct Callbacks {
    std::function<void(const Look&)> answer;              // of what can't wait for the next look
    std::function<void(const std::string& text)> status;  // STATUS=
  };

  // Binds `socket`, a path. The loop must outlive the probe. Throws std::system_error.
  NotifyProbe(EventLoop& loop, std::string socket, bool watchdog, Duration timeout, Callbacks callbacks,
              ProcessorWait wait = ProcessorWait());
  ~NotifyProbe() override;
  NotifyProbe(const NotifyProbe&) = delete;
  NotifyProbe& operator=(const NotifyProbe&) = delete;

  void begin(pid_t pid) override;
  void end() override;
  Look look(Duration now, Duration passed) override;

 private:
  void receive();
  // One datagram: lines of NAME=VALUE.
  void take(std::string_view news);
  void take_line(std::string_view name, std::string_view value);
  void live();

  std::string path_;
  const bool has_watchdog_;
  const Duration given_timeout_;
  Callbacks callbacks_;
  ProcessorWait wait_;
  UniqueFd socket_;
  EventLoop::SourcePtr readable_;

  // Of this run.
  pid_t pid_ = -1;  // -1: there is none
  Duration timeout_;
  bool is_ready_ = false;
  bool is_ending_ = false;
  bool has_triggered_ = false;
  Duration age_{0};  // since the start, or the last sign of life, as far as it counts
};

}  // namespace launch
