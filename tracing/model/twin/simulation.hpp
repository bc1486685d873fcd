// SPDX-License-Identifier: Apache-2.0
// Runs a twin without running anything: events follow one another in virtual time. Same seed, same result.
//
// - Executors execute as those of rclcpp. A wait collects what is ready: timers, then subscriptions, services and
//   clients, one message of each; the next wait comes when all of that has been executed. With several threads one of
//   them waits, and a callback of a mutually exclusive group is passed over while another one of the group runs. An
//   EventsExecutor takes what comes in its order.
// - Processors are shared as scheduler.hpp says.
// - What needs no processor, such as the way of a message, takes one of the recorded times.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <queue>
#include <vector>

#include "tracing/model/twin/description/output_rules.hpp"
#include "tracing/model/twin/description/twin_system.hpp"
#include "tracing/model/twin/figures.hpp"
#include "tracing/model/twin/scheduler.hpp"

namespace tracing::twin {

// Which recorded time a way or a run got, and how long it was in the simulation all in all.
struct SimulatedTime {
  enum class Source { kDelay, kNearDelay, kGap, kRun, kSilentRun };
  Source source = Source::kDelay;
  std::uint32_t place = 0;  // in the values of that distribution
  std::int64_t total_ns = 0;
  std::int64_t begin_ns = 0;  // of the way or the run, in the simulation
};

// Of a callback.
struct SimulatedTimes {
  std::vector<SimulatedTime> ways;  // from sending, or when the timer is due, to the begin
  std::vector<SimulatedTime> runs;
};

class Simulation {
 public:
  // The system must outlive it.
  explicit Simulation(const System& system);
  // For this long, in virtual time. To be called once. Figures count from System::up_ns on, and if the simulation is
  // no longer than twice that, all of it.
  Figures run(std::int64_t duration_ns);
  // After it, of what figures count.
  const std::vector<SimulatedTimes>& times() const { return times_; }

 private:
  // What a callback gets.
  struct Message {
    std::int64_t sent_ns = 0;
    Index publisher = kNone;
    Index client = kNone;           // of a request or a response
    std::int64_t requested_ns = 0;  // likewise
    SimulatedTime way = {};         // without its length
  };
  struct Event {
    enum class Kind { kDue, kTimer, kArrival, kWake };
    std::int64_t time_ns = 0;
    std::uint64_t number = 0;
    Kind kind = Kind::kTimer;
    std::size_t what = 0;  // a callback or a thread
    Message message;
    bool operator<(const Event& other) const {
      return time_ns != other.time_ns ? time_ns > other.time_ns : number > other.number;
    }
  };
  // When a callback was there: what is sent to it before or after is lost, as it was in the recording.
  struct Lifetime {
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
  };
  struct CallbackState {
    std::deque<Message> queue;
    std::int64_t due_ns = 0;   // of a timer
    SimulatedTime way = {};    // likewise, as that of a message
    bool is_due = false;       // likewise
    std::int64_t last_ns = 0;  // the last arrival: messages stay in their order
    Lifetime lifetime;
    Draw delays;
    Draw near_delays;
    Draw gaps;
  };
  struct Thread {
    std::size_t executor = 0;
    Index callback = kNone;  // that it runs; kNone: it waits
    Message message;
    Run run;
    std::size_t step = 0;  // 0: before the begin, then one for each output, then the rest
    std::int64_t worked_ns = 0;
    std::int64_t begin_ns = 0;
    bool slept = false;
  };
  struct ExecutorState {
    std::vector<std::size_t> threads;
    std::vector<Index> callbacks;  // in the order in which a wait finds them
    std::deque<Index> ready;
  };

  // Whether it ends when the recording did. A longer one is several recordings, one after the other.
  bool as_recorded(std::int64_t duration_ns) const { return duration_ns == system_.active_ns; }
  // Whether figures have what began at this time.
  bool counts(std::int64_t time_ns) const { return (is_repeated_ ? time_ns % system_.active_ns : time_ns) >= up_ns_; }
  Lifetime lifetime_of(const Callback& callback, std::int64_t duration_ns) const;
  void push(Event event);
  // Whether its executor has a free thread, and its group nothing that runs.
  bool could_run(Index callback) const;
  void arrive(Index callback, Message message);
  bool is_ready(Index callback) const;
  std::optional<Index> next(ExecutorState& executor);
  // Lets a thread that has just ended a callback, and those that wait, take what is ready.
  void look(std::size_t executor, std::optional<std::size_t> ended);
  void take(std::size_t thread, Index callback, bool goes_on);
  void work(std::size_t thread, std::int64_t work_ns, bool goes_on);
  void step_done(std::size_t thread);
  std::int64_t work_until(const Thread& thread, std::size_t step) const;
  void send(const Output& output);
  void end(std::size_t thread);
  void schedule_timer(Index callback);

  const System& system_;
  OutputRules rules_;
  Scheduler scheduler_;
  std::int64_t now_ns_ = 0;
  std::int64_t up_ns_ = 0;
  bool is_repeated_ = false;  // the recording
  std::uint64_t events_ = 0;
  std::priority_queue<Event> queue_;
  std::vector<CallbackState> callbacks_;
  std::vector<Thread> threads_;
  std::vector<ExecutorState> executors_;
  std::vector<std::size_t> running_;           // by group
  std::vector<std::vector<Index>> receivers_;  // by topic
  std::map<std::string, Index> services_;
  std::map<Index, Index> answers_;  // the callback of each client
  Figures figures_;
  std::vector<SimulatedTimes> times_;
};

}  // namespace tracing::twin
