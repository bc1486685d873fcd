// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/fake/fake_tracer.hpp"

#include <algorithm>

#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/session/session_details.hpp"
#include "tracing/record/session/traceable_events.hpp"

namespace tracing {
namespace {

// How often a blocked finish() asks give_up, which has no way to announce a change.
constexpr std::chrono::milliseconds kAskInterval{1};

}  // namespace

void FakeTracer::block_finish() {
  const std::lock_guard lock(mutex_);
  finish_blocked_ = true;
}

void FakeTracer::release() {
  const std::lock_guard lock(mutex_);
  finish_blocked_ = false;
  changed_.notify_all();
}

void FakeTracer::wait_until_finishing() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return finishing_; });
}

std::vector<std::string> FakeTracer::calls() const {
  const std::lock_guard lock(mutex_);
  return calls_;
}

std::vector<std::string> FakeTracer::open_sessions() const {
  const std::lock_guard lock(mutex_);
  return open_sessions_;
}

std::optional<TraceConfig> FakeTracer::last_config() const {
  const std::lock_guard lock(mutex_);
  return last_config_;
}

SetupReport FakeTracer::start(const TraceConfig& config) {
  const std::lock_guard lock(mutex_);
  calls_.push_back("start " + config.lttng_session_name());
  last_config_ = config;
  if (start_error) {
    throw *start_error;
  }
  open_sessions_.push_back(config.lttng_session_name());
  SetupReport report = setup_report;
  report.trace_directory = config.trace_directory();
  return report;
}

LossAccount FakeTracer::finish(const TraceConfig& config, const std::function<bool()>& give_up) {
  std::unique_lock lock(mutex_);
  const std::string name = config.lttng_session_name();
  calls_.push_back("finish " + name);
  finishing_ = true;
  changed_.notify_all();
  while (finish_blocked_) {
    lock.unlock();
    const bool giving_up = give_up && give_up();
    lock.lock();
    if (giving_up) {
      calls_.push_back("give up " + name);
      break;
    }
    changed_.wait_for(lock, kAskInterval);
  }
  finishing_ = false;
  if (finish_error) {
    throw *finish_error;
  }
  std::erase(open_sessions_, name);
  return losses;
}

std::optional<LossAccount> FakeTracer::pause(const std::string& lttng_session_name) {
  record("pause " + lttng_session_name);
  return losses_in_pause;
}

void FakeTracer::resume(const std::string& lttng_session_name) {
  record("resume " + lttng_session_name);
}

std::string FakeTracer::record_snapshot(const std::string& lttng_session_name) {
  record("record_snapshot " + lttng_session_name);
  return snapshot_directory;
}

std::vector<SessionSummary> FakeTracer::sessions() {
  record("sessions");
  return session_list;
}

SessionDetails FakeTracer::status(const std::string& lttng_session_name) {
  record("status " + lttng_session_name);
  return {.summary = {.name = lttng_session_name, .path = "/traces/" + lttng_session_name, .active = true},
          .channels = {{.domain = "ust",
                        .name = "ros2",
                        .subbuffer_size = 32768,
                        .subbuffer_count = 2,
                        .overwrite = false,
                        .events = {"ros2:a", "ros2:b"}}},
          .losses = losses};
}

TraceableEvents FakeTracer::traceable_events() {
  record("events");
  return events;
}

void FakeTracer::save(const std::string& lttng_session_name, const std::string& directory) {
  record("save " + lttng_session_name + " " + directory);
}

void FakeTracer::load(const std::string& lttng_session_name, const std::string& directory) {
  record("load " + lttng_session_name + " " + directory);
}

void FakeTracer::record(const std::string& call) {
  const std::lock_guard lock(mutex_);
  calls_.push_back(call);
  if (verb_error) {
    throw *verb_error;
  }
}

}  // namespace tracing
