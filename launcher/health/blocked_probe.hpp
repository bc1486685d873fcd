// SPDX-License-Identifier: Apache-2.0
// Whether a process is stopped (state T), or hangs in the kernel (state D), longer than it may.
#pragma once

#include <string>
#include <utility>

#include "launcher/health/health_probe.hpp"

namespace launch {

class BlockedProbe final : public HealthProbe {
 public:
  explicit BlockedProbe(Duration timeout, std::string proc = "/proc") : timeout_(timeout), proc_(std::move(proc)) {}

  void begin(pid_t pid) override {
    pid_ = pid;
    age_ = Duration{0};
  }
  Look look(Duration now, Duration passed) override;

 private:
  Duration timeout_;
  std::string proc_;
  pid_t pid_ = -1;
  char state_ = '?';
  Duration age_{0};
};

}  // namespace launch
