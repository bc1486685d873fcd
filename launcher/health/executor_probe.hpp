// SPDX-License-Identifier: Apache-2.0
// Whether the executors of a process go on. rclcpp of this project tells what each of their threads does
// (executor_progress/progress_page.hpp).
//
// An executor goes on as long as no callback, and nothing between two callbacks, takes longer than the time-out, it
// wakes up for its timers, and some thread spins. The time in which a thread waits for a processor does not count.
#pragma once

#include <array>
#include <cstdint>

#include "executor_progress/progress_page.hpp"
#include "launcher/health/health_probe.hpp"
#include "launcher/health/processor_wait.hpp"

namespace launch {

class ExecutorProbe final : public HealthProbe {
 public:
  // The page must outlive the probe.
  ExecutorProbe(executor_progress::Page& page, Duration timeout, ProcessorWait wait = ProcessorWait())
      : page_(page), timeout_(timeout), wait_(std::move(wait)) {}

  void begin(pid_t pid) override;
  void end() override;
  Look look(Duration now, Duration passed) override;

 private:
  // What is known of the thread of a slot.
  struct Thread {
    std::uint32_t tid = 0;
    std::uint64_t steps = 0;
    Duration age{0};      // how long it has done what it does, as far as it counts; 0: it may do it for ever
    Duration starved{0};  // time in which it waited for a processor, and which does not count
  };

  void follow(const executor_progress::Slot& slot, Thread& thread, Duration now, Duration passed);
  Look judge_process(Duration now, Duration passed);

  executor_progress::Page& page_;
  Duration timeout_;
  ProcessorWait wait_;
  Duration without_executor_{0};
  std::array<Thread, executor_progress::Page::kSlots> threads_{};
};

}  // namespace launch
