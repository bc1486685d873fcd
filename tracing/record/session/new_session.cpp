// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/new_session.hpp"

#include <fmt/core.h>

#include <chrono>
#include <filesystem>
#include <system_error>

#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/session_end.hpp"

namespace tracing {
namespace {

constexpr std::chrono::seconds kLongestEnd{2};

// Where a new recording of a trace goes. A second recording into the same directory would truncate the files of the
// first one, so each further one gets a directory of its own inside. A reader of the trace directory reads all of them.
std::string recording_directory(const TraceConfig& config) {
  const std::filesystem::path directory = config.trace_directory();
  if (!std::filesystem::exists(directory / "ust") && !std::filesystem::exists(directory / "kernel")) {
    return directory.string();
  }
  for (int number = 1;; ++number) {
    const std::filesystem::path appended = directory / fmt::format("appended-{}", number);
    if (!std::filesystem::exists(appended)) {
      return appended.string();
    }
  }
}

int create(const TraceConfig& config, const std::string& directory) {
  const std::string name = config.lttng_session_name();
  if (config.records_snapshots()) {
    return lttng_create_session_snapshot(name.c_str(), nullptr);
  }
  if (config.live_timer != 0) {
    return lttng_create_session_live(name.c_str(), config.destination().c_str(), config.live_timer);
  }
  return lttng_create_session(name.c_str(), config.over_network() ? config.destination().c_str() : directory.c_str());
}

}  // namespace

NewSession::NewSession(const TraceConfig& config) : name_(config.lttng_session_name()) {
  const std::string directory = config.over_network() ? "" : recording_directory(config);
  if (!std::filesystem::exists(directory)) {
    directory_ = directory;
  }
  const int result = create(config, directory);
  if (result == -LTTNG_ERR_EXIST_SESS) {
    throw TraceError(fmt::format("trace session '{}' exists already", name_),
                     fmt::format("end it with `lttng destroy {}`, or choose another session-name", name_));
  }
  check_lttng(result, fmt::format("create trace session '{}'", name_));
}

NewSession::~NewSession() {
  if (kept_) {
    return;
  }
  if (directory_.empty()) {
    lttng_destroy_session_no_wait(name_.c_str());
    return;
  }
  // LTTng writes there until the session has gone.
  try {
    const auto give_up = std::chrono::steady_clock::now() + kLongestEnd;
    destroy_session(name_, [give_up] { return std::chrono::steady_clock::now() > give_up; });
  } catch (const TraceError&) {
    // It has gone.
  }
  std::error_code none;
  std::filesystem::remove_all(directory_, none);
}

}  // namespace tracing
