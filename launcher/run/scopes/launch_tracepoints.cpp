// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/scopes/launch_tracepoints.hpp"

#include <dlfcn.h>

#include <chrono>
#include <utility>

namespace launch {

namespace {

using std::chrono::steady_clock;

// LTTng-UST tells nobody when a session enables an event.
constexpr std::chrono::milliseconds kBetweenLooks{10};
constexpr std::chrono::seconds kLongestRegistration{60};
// The processes of the launch have ended, and the user waits.
constexpr std::chrono::seconds kLongestWaitAtEnd{5};

launch_trace_kind trace_kind_of(LaunchRecord::Kind kind) {
  switch (kind) {
    case LaunchRecord::Kind::kLoad:
      return LAUNCH_TRACE_LOAD;
    case LaunchRecord::Kind::kInclude:
      return LAUNCH_TRACE_INCLUDE;
    case LaunchRecord::Kind::kVisit:
      return LAUNCH_TRACE_VISIT;
    case LaunchRecord::Kind::kReady:
      return LAUNCH_TRACE_READY;
    case LaunchRecord::Kind::kSpawn:
      return LAUNCH_TRACE_SPAWN;
    case LaunchRecord::Kind::kExec:
      return LAUNCH_TRACE_EXEC;
    case LaunchRecord::Kind::kExit:
      return LAUNCH_TRACE_EXIT;
    case LaunchRecord::Kind::kRespawn:
      return LAUNCH_TRACE_RESPAWN;
    case LaunchRecord::Kind::kSignal:
      return LAUNCH_TRACE_SIGNAL;
    case LaunchRecord::Kind::kScheduling:
      return LAUNCH_TRACE_SCHEDULING;
    case LaunchRecord::Kind::kCondition:
      return LAUNCH_TRACE_CONDITION;
  }
  return LAUNCH_TRACE_VISIT;
}

void fire(launch_trace_fire_function function, const LaunchRecord& record) {
  const bool placed = static_cast<bool>(record.where);
  const launch_trace_event event = {.kind = trace_kind_of(record.kind),
                                    .time = record.time,
                                    .duration = record.duration,
                                    .name = record.name.c_str(),
                                    .what = record.what.c_str(),
                                    .file = placed ? record.where.file->path().c_str() : "",
                                    .line = placed ? record.where.file->position(record.where.begin).line : 0,
                                    .pid = record.pid,
                                    .value = record.value};
  function(&event);
}

}  // namespace

void LaunchTracepoints::begin() {
  {
    const std::lock_guard lock(mutex_);
    if (state_ == State::kOpening || state_ == State::kOpen) {
      return;
    }
    state_ = State::kOpening;
  }
  opener_ = std::thread([this] { open(); });
}

void LaunchTracepoints::open() {
  // The library is never closed again: LTTng-UST's threads run in it.
  void* const library = ::dlopen((prefix_ + "/lib/launch/liblaunch_trace.so").c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const function = library != nullptr ? ::dlsym(library, "launch_trace_fire") : nullptr;
  void* const enabled = library != nullptr ? ::dlsym(library, "launch_trace_enabled") : nullptr;
  std::unique_lock lock(mutex_);
  if (function == nullptr || enabled == nullptr) {
    kept_.clear();
    state_ = State::kDropping;
    return;
  }
  wait_until_enabled(lock, reinterpret_cast<launch_trace_enabled_function>(enabled));
  const std::vector<LaunchRecord> kept = std::exchange(kept_, {});
  fire_ = reinterpret_cast<launch_trace_fire_function>(function);
  for (const LaunchRecord& record : kept) {
    fire(fire_, record);
  }
  state_ = State::kOpen;
}

void LaunchTracepoints::wait_until_enabled(std::unique_lock<std::mutex>& lock, launch_trace_enabled_function enabled) {
  steady_clock::time_point until = steady_clock::now() + kLongestRegistration;
  bool ends = false;
  while (enabled() == 0 && steady_clock::now() < until) {
    ending_.wait_for(lock, kBetweenLooks);
    if (!std::exchange(ends, end_) && ends) {
      until = steady_clock::now() + kLongestWaitAtEnd;
    }
  }
}

void LaunchTracepoints::drop() {
  const std::lock_guard lock(mutex_);
  if (state_ == State::kKeeping) {
    state_ = State::kDropping;
    kept_.clear();
  }
}

void LaunchTracepoints::record(LaunchRecord record) {
  const std::lock_guard lock(mutex_);
  if (state_ == State::kOpen) {
    fire(fire_, record);
  } else if (state_ != State::kDropping) {
    kept_.push_back(std::move(record));
  }
}

void LaunchTracepoints::end() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ending_.notify_one();
  if (opener_.joinable()) {
    opener_.join();
  }
}

}  // namespace launch
