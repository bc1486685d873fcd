// SPDX-License-Identifier: Apache-2.0
// A twin of a traced system: the same graph, rates and run times, with stand-ins that compute nothing.
//
// Parts refer to one another by their index. Times are in nanoseconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tracing/model/twin/description/distribution.hpp"

namespace tracing::twin {

using Index = std::size_t;
inline constexpr Index kNone = static_cast<Index>(-1);

struct Process {
  std::string name;
};

struct Executor {
  enum class Kind { kSingle, kMulti, kEvents };
  Index process = kNone;
  Kind kind = Kind::kSingle;
  std::size_t threads = 1;
  int priority = 0;  // 0: that of an ordinary process; 1 to 99: SCHED_FIFO
  bool operator==(const Executor&) const = default;
};

// In the order of Executor::Kind.
inline constexpr const char* kExecutorKinds[] = {"single", "multi", "events"};

struct Node {
  Index process = kNone;
  std::string name;  // fully qualified
  bool intra_process = false;
};

// A callback group.
struct Group {
  Index node = kNone;
  Index executor = kNone;
  bool reentrant = false;
  bool operator==(const Group&) const = default;
};

struct Topic {
  std::string name;
  std::uint64_t bytes = 0;  // of a message of the twin
};

struct Qos {
  bool reliable = true;
  std::uint64_t depth = 10;  // 0: all messages are kept
};

struct Publisher {
  Index node = kNone;
  Index topic = kNone;
  Qos qos;
};

struct Client {
  Index node = kNone;
  std::string service;
};

// What a callback sends.
struct Output {
  enum class Rule {
    kAlways,  // in each run
    kEvery,   // in each `every`-th run
    kJoin,    // in the run that has completed the inputs since the last time
    kChance,  // in some runs
  };
  Index publisher = kNone;  // one of these two is set
  Index client = kNone;
  Rule rule = Rule::kAlways;
  std::size_t every = 1;
  double chance = 1;
  std::vector<Index> inputs;  // of kJoin: callbacks, this one among them
  std::size_t times = 1;      // messages in one run
  double called = 1;          // which part of the run is over when it calls publish()
  double sent = 1;            // … and when the message is on its way
};

// In the order of Output::Rule.
inline constexpr const char* kOutputRules[] = {"always", "every", "join", "chance"};

struct Callback {
  enum class Kind { kTimer, kSubscription, kService, kClient };
  std::string name;  // "/planner, timer 100 ms": unique
  Kind kind = Kind::kTimer;
  Index group = kNone;
  Index topic = kNone;         // of a subscription
  Qos qos;                     // likewise
  std::string service;         // of a service
  Index client = kNone;        // of a client
  std::int64_t period_ns = 0;  // of a timer
  std::int64_t phase_ns = 0;   // of a timer: when it is due first, after the others
  bool replaces_loop = false;  // a timer in place of code that sent outside of callbacks
  std::uint64_t runs = 0;      // that were recorded
  Distribution run_times;      // of runs that send something; of all if `silent_run_times` is empty
  Distribution silent_run_times;
  std::int64_t overhead_ns = 0;  // that a stand-in needs beside its work, as a run of the twin has shown
  double blocked = 0;            // the part of a run in which it needs no processor
  Distribution delays;           // from sending, or when a timer is due, to the begin, if the executor waits for it
  Distribution near_delays;      // likewise, of messages of the same process; empty: as the others
  Distribution gaps;             // from the end of the callback before to the begin, if the executor was busy
  Distribution ways;             // from sending, or when a timer is due, to the begin, of all that were recorded
  std::vector<Output> outputs;
};

// In the order of Callback::Kind.
inline constexpr const char* kCallbackKinds[] = {"timer", "subscription", "service", "client"};

struct System {
  std::int64_t duration_ns = 0;  // of the recording
  std::int64_t begin_ns = 0;     // when the first timer was due
  std::int64_t active_ns = 0;    // from the time when the first timer was due to the end of the last callback
  std::int64_t up_ns = 0;        // from the time when the first timer was due to begin_of_figures()
  double slack = 1;              // of a simulation: Cycle::slack
  Cycle cycle() const { return {begin_ns, active_ns, slack}; }
  std::size_t cpus = 1;
  std::uint64_t seed = 1;
  // Whether the times of runs are those that they had a processor. Otherwise they may have waited for one in them, and
  // a stand-in takes the time that passes.
  bool processor_times = true;
  std::vector<Process> processes;
  std::vector<Executor> executors;
  std::vector<Node> nodes;
  std::vector<Group> groups;
  std::vector<Topic> topics;
  std::vector<Publisher> publishers;
  std::vector<Client> clients;
  std::vector<Callback> callbacks;
  std::vector<std::string> missing;  // sentences: what cannot be twinned, and what is an assumption
};

}  // namespace tracing::twin
