// SPDX-License-Identifier: Apache-2.0
// Whether somebody listens on a port or a socket. A connection is made, and closed at once. Nothing is sent to a port
// of UDP: the kernel tells whether it is bound, in the network of the process.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "base/files/unique_fd.hpp"
#include "launcher/health/health_probe.hpp"
#include "launcher/process/health_watch.hpp"

namespace launch {

class PortProbe final : public HealthProbe {
 public:
  // `answer` gets what a connection comes to that takes longer than a look. The loop must outlive the probe.
  PortProbe(EventLoop& loop, PortAccepts port, Duration timeout, std::function<void(const Look&)> answer,
            std::string proc = "/proc")
      : loop_(loop), port_(std::move(port)), timeout_(timeout), answer_(std::move(answer)), proc_(std::move(proc)) {}

  void begin(pid_t pid) override {
    pid_ = pid;
    is_elsewhere_.reset();
  }
  void end() override { abandon(); }
  // Does nothing as long as a connection is under way.
  Look look(Duration now, Duration passed) override;

 private:
  Look look_for_bound_port() const;
  Look connect_to_socket() const;
  Look connect_to_port(const std::string& host);
  Look or_fallback(Look look);
  bool is_elsewhere() const;
  void on_connected();
  void abandon();
  Look refused(int error) const;

  EventLoop& loop_;
  PortAccepts port_;
  Duration timeout_;
  std::function<void(const Look&)> answer_;
  std::string proc_;
  pid_t pid_ = -1;
  std::optional<bool> is_elsewhere_;  // looked up once in a run
  bool has_fallback_ = false;
  UniqueFd connection_;  // under way
  EventLoop::SourcePtr connected_;
  EventLoop::SourcePtr too_late_;
};

}  // namespace launch
