// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/daemons_kept_going.hpp"

#include <fmt/core.h>
#include <signal.h>

#include <chrono>
#include <utility>

#include "tracing/record/lttng/consumer_priority.hpp"
#include "tracing/record/lttng/session_daemon.hpp"

namespace tracing {
namespace {

// Nobody tells of a process that is stopped, but to its parent.
constexpr std::chrono::milliseconds kKeepInterval{100};

}  // namespace

DaemonsKeptGoing::DaemonsKeptGoing() {
  look();
  thread_ = std::thread([this] {
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, kKeepInterval, [this] { return stop_; })) {
      lock.unlock();
      look();
      lock.lock();
    }
  });
}

DaemonsKeptGoing::~DaemonsKeptGoing() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void DaemonsKeptGoing::keep_relay_daemons(std::function<std::vector<pid_t>()> stopped) {
  {
    const std::lock_guard lock(mutex_);
    relay_daemons_ = std::move(stopped);
  }
  look();
}

std::vector<std::string> DaemonsKeptGoing::notes() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> notes;
  for (const auto& [pid, note] : continued_) {
    notes.push_back(note);
  }
  return notes;
}

void DaemonsKeptGoing::look() {
  const std::lock_guard lock(mutex_);
  const pid_t daemon = session_daemon_pid();
  if (daemon == 0) {
    return;
  }
  constexpr const char* kFileMaker = "a process that makes files for LTTng's daemons";
  continue_process(daemon, "LTTng's session daemon");
  for (const pid_t maker : file_makers_of(daemon)) {
    continue_process(maker, kFileMaker);
  }
  for (const pid_t consumer : consumers_of(daemon)) {
    continue_process(consumer, "LTTng's consumer");
    for (const pid_t maker : file_makers_of(consumer)) {
      continue_process(maker, kFileMaker);
    }
  }
  if (relay_daemons_) {
    for (const pid_t relay_daemon : relay_daemons_()) {
      continue_process(relay_daemon, "the relay daemon");
    }
  }
}

void DaemonsKeptGoing::continue_process(pid_t pid, const char* what) {
  if (is_stopped(pid) && kill(pid, SIGCONT) == 0) {
    continued_.try_emplace(
        pid, fmt::format("{} (process {}) was stopped; it was continued, so that the session could end", what, pid));
  }
}

}  // namespace tracing
