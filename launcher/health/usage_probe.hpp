// SPDX-License-Identifier: Apache-2.0
// Whether a process stays within the memory and the processor time that the launch file expects. Nothing is limited:
// the process alone is looked at, not what it has started.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "base/processes/process_usage.hpp"
#include "launcher/health/health_probe.hpp"
#include "launcher/process/health_watch.hpp"

namespace launch {

using UsageOf = std::function<std::optional<ProcessUsage>(pid_t pid)>;

class MemoryProbe final : public HealthProbe {
 public:
  // Growth counts from the first look after `start_period`.
  MemoryProbe(MemoryStays limits, Duration timeout, Duration start_period, UsageOf usage = read_process_usage)
      : limits_(limits), timeout_(timeout), start_period_(start_period), usage_(std::move(usage)) {}

  void begin(pid_t pid) override {
    pid_ = pid;
    ran_ = above_ = Duration{0};
    first_.reset();
  }
  Look look(Duration now, Duration passed) override;

 private:
  const MemoryStays limits_;
  const Duration timeout_;
  const Duration start_period_;
  const UsageOf usage_;
  pid_t pid_ = -1;
  Duration ran_{0};
  Duration above_{0};                   // for so long without a break
  std::optional<std::uint64_t> first_;  // bytes that growth counts from
};

class LoadProbe final : public HealthProbe {
 public:
  LoadProbe(LoadStays limit, Duration timeout, UsageOf usage = read_process_usage)
      : limit_(limit), timeout_(timeout), usage_(std::move(usage)) {}

  void begin(pid_t pid) override {
    pid_ = pid;
    used_.reset();
    newest_.clear();
  }
  Look look(Duration now, Duration passed) override;

 private:
  struct Part {
    Duration passed;
    double used = 0;  // seconds of processor time
  };

  const LoadStays limit_;
  const Duration timeout_;
  const UsageOf usage_;
  pid_t pid_ = -1;
  std::optional<double> used_;  // at the last look, since the start of the process
  std::deque<Part> newest_;     // as many as the time-out needs
};

}  // namespace launch
