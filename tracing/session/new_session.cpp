// SPDX-License-Identifier: Apache-2.0
#include "tracing/session/new_session.hpp"

#include <fmt/core.h>
#include <lttng/lttng.h>

#include <filesystem>

#include "tracing/lttng/lttng_error.hpp"
#include "tracing/plan/trace_error.hpp"

namespace tracing {
namespace {

// Where a new recording of a trace goes. A second recording into the same directory would truncate the files of the
// first one, so each further one gets a directory of its own inside. A reader of the trace directory reads all of them.
std::string recording_directory(const TraceConfig& config) {
  const std::filesystem::path directory = config.trace_directory();
  if (!std::filesystem::exists(directory / "ust") && !std::filesystem::exists(directory / "kernel")) {
    return directory.string();
  }
  for (int number = 1;; ++number) {
    const std::filesystem::path appended = directory / fmt::format("appended-{}", number);
    if (!std::filesystem::exists(appended)) return appended.string();
  }
}

int create(const TraceConfig& config) {
  const std::string name = config.lttng_session_name();
  if (config.records_snapshots()) return lttng_create_session_snapshot(name.c_str(), nullptr);
  if (config.live_timer != 0) {
    return lttng_create_session_live(name.c_str(), config.destination().c_str(), config.live_timer);
  }
  const std::string destination = config.over_network() ? config.destination() : recording_directory(config);
  return lttng_create_session(name.c_str(), destination.c_str());
}

}  // namespace

NewSession::NewSession(const TraceConfig& config) : name_(config.lttng_session_name()) {
  const int result = create(config);
  if (result == -LTTNG_ERR_EXIST_SESS) {
    throw TraceError(fmt::format("trace session '{}' exists already", name_),
                     fmt::format("end it with `lttng destroy {}`, or choose another session-name", name_));
  }
  check_lttng(result, fmt::format("create trace session '{}'", name_));
}

NewSession::~NewSession() {
  if (!kept_) lttng_destroy_session_no_wait(name_.c_str());
}

}  // namespace tracing
