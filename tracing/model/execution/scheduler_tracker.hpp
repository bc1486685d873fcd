// SPDX-License-Identifier: Apache-2.0
// What threads did on the machine, from the kernel's events sched_switch, sched_wakeup and sched_waking.
//
// A thread is recognised by the context vtid of its first sched_switch, so what it did before is not told.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tracing/decode/reader/event.hpp"
#include "tracing/model/execution/execution_sink.hpp"

namespace tracing {

class SchedulerTracker {
 public:
  using Tell = std::function<void(const ThreadInterval&)>;
  explicit SchedulerTracker(Tell tell) : tell_(std::move(tell)) {}

  // Returns whether it is one of these events. `process`: that of the event.
  bool on_event(const Event& event, ProcessId process);

 private:
  enum class Kind : std::uint8_t { kOther, kSwitch, kWakeup };
  struct Plan {
    Kind kind = Kind::kOther;
    std::size_t previous_tid = 0;  // indices of fields
    std::size_t previous_state = 0;
    std::size_t previous_name = 0;
    std::size_t next_tid = 0;
    std::size_t tid = 0;
    std::optional<std::size_t> target_cpu{};
    std::optional<std::size_t> next_name{};
  };
  struct KernelThread {
    std::optional<ThreadId> id;  // nullopt until it was switched off once
    ThreadInterval::State state = ThreadInterval::State::kBlocked;
    std::int64_t since_ns = 0;  // 0: not known yet
    std::int64_t cpu = 0;
  };
  // A time in which a thread had a processor.
  struct Turn {
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
    std::int64_t tid = 0;
  };
  struct Processor {
    Turn turn;  // of the thread that has it; it has no end yet
    std::deque<Turn> newest;
  };
  struct Other {
    std::int64_t tid = 0;
    std::int64_t ns = 0;
  };

  static Plan plan_of(const EventClass& event_class);
  KernelThread& thread(std::int64_t tid) { return threads_[tid]; }
  // `other`: of the state that ends.
  void change(KernelThread& thread, ThreadInterval::State state, std::int64_t time_ns, const Other& other);
  void end_turn(std::int64_t cpu, std::int64_t time_ns, std::int64_t tid, std::int64_t next_tid);
  // Who had the processor longest in this time.
  Other longest_on(std::int64_t cpu, std::int64_t begin_ns, std::int64_t end_ns) const;
  void on_switch(const Event& event, const Plan& plan, ProcessId process);
  void set_name(std::int64_t tid, std::string_view name);

  Tell tell_;
  std::vector<std::optional<Plan>> plans_;                  // by EventClass::id
  std::unordered_map<std::int64_t, KernelThread> threads_;  // by the kernel's number
  std::unordered_map<std::int64_t, std::string> names_;     // likewise
  std::unordered_map<std::int64_t, Processor> processors_;
};

}  // namespace tracing
