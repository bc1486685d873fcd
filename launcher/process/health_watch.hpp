// SPDX-License-Identifier: Apache-2.0
// How it is told whether a process that runs is healthy: one `watch` of a launch file. Plain data; launcher/health
// looks.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

// The executors of the process go on: no callback takes longer than the time-out, and nothing else keeps them.
struct ExecutorProgress {};
// A line is printed at least once in the time-out.
struct OutputLines {
  std::string pattern;          // regular expression to be found in the line; empty: any line
  std::string stream = "both";  // stdout, stderr or both
};
// The process is neither stopped (state T) nor does it hang in the kernel (state D) longer than the time-out.
struct NotBlocked {};

// A command ends with exit code 0, within the time-out.
struct CommandSucceeds {
  std::vector<std::string> argv;
};

// Messages are published on a topic.
struct TopicIsPublished {
  std::string topic;
  double min_rate = 0;  // messages a second in each time-out; 0: one message in it
};

// A service is there. If it can be called without an effect (rcl_interfaces/srv/GetParameters), it answers within the
// time-out.
struct ServiceAnswers {
  std::string service;
};

// A managed node is in a state. It says so itself, within the time-out.
struct LifecycleState {
  std::string node;
  std::string state;  // unconfigured, inactive, active or finalized
};

// Somebody listens: connections are accepted, or a port of UDP is bound.
struct PortAccepts {
  enum class Protocol { kTcp, kUdp, kUnix };
  Protocol protocol = Protocol::kTcp;
  std::string host;        // an address, or "localhost"
  std::uint16_t port = 0;  // of kTcp and kUdp
  std::string socket;      // of kUnix: a path, or an abstract name behind "@"
};

// The process says by sd_notify(3) that it is ready, within the time-out; then, if it has a watchdog, that it lives, at
// least once in the time-out.
struct Notifies {
  bool watchdog = false;
};

// The process does not have more resident memory than this, in bytes, for the time-out.
struct MemoryStays {
  std::optional<std::uint64_t> most;
  std::optional<std::uint64_t> most_growth;  // since the first look after the start period
};
// Over each time-out, the threads of the process do not use more than this share of one processor.
struct LoadStays {
  double most = 0;
};

using WatchSubject = std::variant<ExecutorProgress, OutputLines, NotBlocked, CommandSucceeds, TopicIsPublished,
                                  ServiceAnswers, LifecycleState, PortAccepts, Notifies, MemoryStays, LoadStays>;

// What follows when the process gets unhealthy.
enum class OnUnhealthy { kNothing, kRestart, kSignal, kShutdown };

struct HealthWatch {
  WatchSubject subject;
  Duration timeout = std::chrono::seconds(5);
  Duration interval = std::chrono::seconds(1);  // between two looks
  std::int64_t failures = 1;                    // so many in a row make the process unhealthy
  Duration start_period{0};                     // from the start of the process: failures do not count
  OnUnhealthy reaction = OnUnhealthy::kNothing;
  int signal = 0;  // of kSignal
  SourceRange where;
};

// "127.0.0.1:8080", "[::1]:8080", "/run/map.sock"
std::string address_of(const PortAccepts& port);

// "512.0 MiB"
std::string size_text(std::uint64_t bytes);

// "executor", "output", "blocked", "command" and so on: the word of a launch file.
std::string_view kind_of(const HealthWatch& watch);
// "none", "restart", "signal", "shutdown".
std::string_view to_string(OnUnhealthy reaction);
// "it prints any line at least every 5 s, else restart"
std::string describe(const HealthWatch& watch);

}  // namespace launch
