// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/run_watch.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/statvfs.h>

#include <algorithm>
#include <utility>

#include "base/monotonic_clock.hpp"
#include "base/processes/process_stat.hpp"
#include "tracing/record/account/counters/event_counters.hpp"
#include "tracing/record/kernel/kernel_recorder.hpp"
#include "tracing/record/lttng/consumer_priority.hpp"
#include "tracing/record/lttng/relay_connection.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/session/held_up_streams.hpp"

namespace tracing {
namespace {

constexpr std::chrono::milliseconds kWatchInterval{500};
// Less than this is left when LTTng's consumer fails to write a packet.
constexpr std::uint64_t kNoRoom = 65536;  // bytes

// The first look at the streams after the end of a process, and how often they are looked at until it is known whether
// they go on.
constexpr std::chrono::milliseconds kStreamInterval{100};
constexpr std::size_t kMostNamed = 4;  // processes

constexpr const char* kDaemonName = "lttng-sessiond";
constexpr const char* kConsumerName = "lttng-consumerd";

bool runs(const launch::ProcessStat& process, const std::string& name) {
  return process.name == name && process.state != 'Z';
}

bool is_stopped(const launch::ProcessStat& process) {
  return process.state == 'T' || process.state == 't';
}

std::string consumer_ended(pid_t consumer, pid_t daemon) {
  return fmt::format(
      "LTTng's consumer (process {}) has ended: nothing is written any more, and the trace ends here; {}", consumer,
      session_daemon_is_ours()
          ? "the next trace starts another one"
          : fmt::format("the session daemon starts no other one, so end it before the next trace: `kill {}`", daemon));
}

std::string processors_of(const std::vector<HeldUpStream>& streams) {
  std::set<std::uint32_t> processors;
  for (const HeldUpStream& stream : streams) {
    processors.insert(stream.processor);
  }
  return fmt::format("processor{} {}", processors.size() == 1 ? "" : "s", fmt::join(processors, ", "));
}

}  // namespace

RunWatch::RunWatch(const TraceConfig& config, std::function<void(const std::string&)> told)
    : directory_(config.over_network() ? "" : config.trace_directory()),
      address_(config.over_network() ? config.destination() : ""),
      counters_(config.event_counters),
      told_(std::move(told)),
      daemon_(session_daemon_pid()),
      consumers_(consumers_of(daemon_)),
      kernel_recorder_(directory_.empty() ? 0 : kernel_recorder_process(directory_)),
      // A snapshot is sent over connections of its own.
      relay_(config.over_network() && !config.records_snapshots()
                 ? std::make_unique<RelayConnection>(relay_ports(address_), consumers_)
                 : nullptr),
      streams_(config.buffers_ust == BufferOwner::kUser
                   ? std::make_unique<HeldUpStreams>(config.lttng_session_name(), consumers_)
                   : nullptr),
      thread_([this] { watch(); }) {}

RunWatch::~RunWatch() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void RunWatch::process_ended(const std::string& name) {
  if (!streams_) {
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    ended_.push_back({name, static_cast<std::uint64_t>(launch::monotonic_time())});
  }
  changed_.notify_one();
}

void RunWatch::watch() {
  using Clock = std::chrono::steady_clock;
  Clock::time_point next = Clock::now() + kWatchInterval;
  std::optional<Clock::time_point> next_of_streams;
  std::unique_lock lock(mutex_);
  while (!stop_) {
    changed_.wait_until(lock, std::min(next, next_of_streams.value_or(next)),
                        [&] { return stop_ || (!ended_.empty() && !next_of_streams); });
    if (stop_) {
      break;
    }
    if (!ended_.empty() && !next_of_streams) {
      next_of_streams = Clock::now() + kStreamInterval;
    }
    const Clock::time_point now = Clock::now();
    const bool streams_are_due = next_of_streams && now >= *next_of_streams;
    const std::vector<EndedProcess> ended = streams_are_due ? std::exchange(ended_, {}) : std::vector<EndedProcess>();
    lock.unlock();
    if (streams_are_due) {
      next_of_streams = look_at_streams(ended);
    }
    if (now >= next) {
      look_at_daemon();
      look_at_consumers();
      look_at_kernel_recorder();
      look_at_room();
      look_at_relay_daemon();
      look_at_counters();
      next = Clock::now() + kWatchInterval;
    }
    lock.lock();
  }
}

std::optional<std::chrono::steady_clock::time_point> RunWatch::look_at_streams(const std::vector<EndedProcess>& ended) {
  lately_ended_.insert(lately_ended_.end(), ended.begin(), ended.end());
  const HeldUpStreams::Look look = streams_->look();
  if (!look.held_up.empty()) {
    told_(streams_are_held_up(look.held_up));
  }
  if (!look.released.empty()) {
    told_(
        fmt::format("the events of {} are recorded after all: the event was completed", processors_of(look.released)));
  }
  if (streams_->is_settled()) {
    lately_ended_.clear();
    return std::nullopt;
  }
  return std::chrono::steady_clock::now() + (streams_->is_sure() ? kWatchInterval : kStreamInterval);
}

std::string RunWatch::streams_are_held_up(const std::vector<HeldUpStream>& streams) const {
  std::uint64_t since = streams.front().since;
  std::uint64_t seen = 0;
  for (const HeldUpStream& stream : streams) {
    since = std::min(since, stream.since);
    seen = std::max(seen, stream.seen);
  }
  std::set<std::string> names;
  for (const EndedProcess& process : lately_ended_) {
    if (process.time <= seen) {
      names.insert(process.name);
    }
  }
  const std::string who =
      names.empty() || names.size() > kMostNamed ? "a process" : fmt::format("{}", fmt::join(names, " or "));
  const std::string from =
      seen > since ? fmt::format("since {:.1f} s before", static_cast<double>(seen - since) / 1e9) : "from now on";
  return fmt::format(
      "{} died within an event: what {} records is lost {}, also of other processes; start the launch anew to record "
      "it again; with buffers-ust=\"pid\" such a death costs only events of its own process",
      who, processors_of(streams), from);
}

void RunWatch::look_at_daemon() {
  if (daemon_ == 0) {
    return;
  }
  const launch::ProcessStat daemon = launch::read_process_stat(daemon_);
  say(!runs(daemon, kDaemonName),
      fmt::format("the LTTng session daemon (process {}) has ended: nothing is recorded any more, and the trace ends "
                  "here; the system goes on",
                  daemon_));
  say(is_stopped(daemon),
      fmt::format("the LTTng session daemon (process {}) is stopped: processes that start now are not recorded; "
                  "continue it with `kill -CONT {}`",
                  daemon_, daemon_));
}

void RunWatch::look_at_consumers() {
  if (!runs(launch::read_process_stat(daemon_), kDaemonName)) {
    return;  // they end with it
  }
  for (const pid_t consumer : consumers_) {
    const launch::ProcessStat process = launch::read_process_stat(consumer);
    if (!runs(process, kConsumerName)) {
      say(true, consumer_ended(consumer, daemon_));  // it never runs again
    }
    say(is_stopped(process),
        fmt::format("LTTng's consumer (process {}) is stopped: events are lost when the buffers are full; continue it "
                    "with `kill -CONT {}`",
                    consumer, consumer));
  }
}

void RunWatch::look_at_kernel_recorder() {
  if (kernel_recorder_ == 0) {
    return;
  }
  // /proc has the first 15 bytes of the name.
  say(!runs(launch::read_process_stat(kernel_recorder_), std::string(kKernelRecorder).substr(0, 15)),
      fmt::format("the recorder of kernel events (process {}) has ended: kernel events are not recorded any more",
                  kernel_recorder_));
}

void RunWatch::look_at_room() {
  struct statvfs usage {};
  if (directory_.empty() || statvfs(directory_.c_str(), &usage) != 0) {
    return;
  }
  say(std::uint64_t{usage.f_bavail} * usage.f_frsize < kNoRoom,
      fmt::format("the file system of {} is full: events are lost from now on, also when there is room again; the "
                  "system goes on",
                  directory_.string()));
}

void RunWatch::look_at_relay_daemon() {
  if (!relay_) {
    return;
  }
  const RelayConnection::State state = relay_->look();
  say(state == RelayConnection::State::kEnded,
      fmt::format(
          "the relay daemon at {} is gone: the trace there ends here, and what is recorded from now on is lost; "
          "the system goes on",
          address_));
  say(state == RelayConnection::State::kSilent,
      fmt::format("the relay daemon at {} takes no data: events are lost when the buffers are full; see whether it is "
                  "stopped",
                  address_));
}

void RunWatch::look_at_counters() {
  constexpr int kEvery = 10;  // looks
  if (!counters_.empty() && ++looks_ % kEvery == 0) {
    EventCounters::put_ended_processes_away(counters_);
  }
}

void RunWatch::say(bool is_so, const std::string& sentence) {
  if (!is_so) {
    said_.erase(sentence);
  } else if (said_.insert(sentence).second) {
    told_(sentence);
  }
}

}  // namespace tracing
