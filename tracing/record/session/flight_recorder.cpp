// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/flight_recorder.hpp"

#include <algorithm>
#include <utility>

#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/snapshot.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

}  // namespace

FlightRecorder::FlightRecorder(const TraceConfig& config, std::function<void(const TakenSnapshot&)> told)
    : config_(config), told_(std::move(told)), thread_([this] { work(); }) {}

FlightRecorder::~FlightRecorder() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void FlightRecorder::request(const std::string& reason, const std::string& died) {
  {
    const std::lock_guard lock(mutex_);
    if (!died.empty()) {
      died_.push_back(died);
    }
    if (std::find(requested_.begin(), requested_.end(), reason) != requested_.end()) {
      return;
    }
    requested_.push_back(reason);
  }
  changed_.notify_one();
}

void FlightRecorder::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stop_ || !requested_.empty(); });
    if (requested_.empty()) {
      return;
    }
    std::vector<std::string> reasons = std::exchange(requested_, {});
    std::vector<std::string> died = std::exchange(died_, {});
    lock.unlock();
    told_(take({.reasons = std::move(reasons), .died = std::move(died)}));
    lock.lock();
  }
}

TakenSnapshot FlightRecorder::take(SnapshotOrder order) const {
  TakenSnapshot taken = take_snapshot(config_, std::move(order));
  if (taken.error.empty() && !config_.over_network()) {
    const std::vector<fs::path> snapshots = snapshots_in(config_.trace_directory());
    try {
      for (std::size_t oldest = 0; snapshots.size() - oldest > config_.snapshot_limit; ++oldest) {
        fs::remove_all(snapshots[oldest]);
      }
    } catch (const std::exception& error) {
      taken.error = error.what();
    }
  }
  return taken;
}

TakenSnapshot take_snapshot(const TraceConfig& config, SnapshotOrder order) {
  TakenSnapshot taken{.reasons = std::move(order.reasons), .directory = {}, .damage = {}, .error = {}};
  try {
    const std::uint64_t asked = record_snapshot(config.lttng_session_name());
    if (!config.over_network()) {
      const std::vector<fs::path> snapshots = snapshots_in(config.trace_directory());
      if (snapshots.empty()) {
        throw TraceError("LTTng has written no snapshot");
      }
      taken.directory = snapshots.back();
      taken.damage = judge_snapshot(taken.directory, config.lttng_session_name(), config.event_counters, taken.reasons,
                                    {.asked = asked, .died = std::move(order.died), .of_reason = order.moment});
    }
  } catch (const std::exception& error) {
    taken.error = error.what();
  }
  have_objects_told_again(config.lttng_session_name());
  return taken;
}

}  // namespace tracing
