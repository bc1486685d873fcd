// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/checks/setup_checks.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

void check_relay_daemon(const TraceConfig& config) {
  if (!config.url.empty() && !config.url.starts_with("net://") && !config.url.starts_with("net6://")) {
    throw TraceError(fmt::format("'{}' is no address of a relay daemon", config.url),
                     "write net://HOST[:CONTROL[:DATA]]; a directory is given by base-path (launch trace: --path)");
  }
  if (config.live_timer != 0 && config.records_snapshots()) {
    throw TraceError(fmt::format("trace session '{}' is both live and a snapshot session", config.session_name),
                     "leave live-timer or snapshot-mode out");
  }
}

}  // namespace

void check_config(const TraceConfig& config) {
  if (config.session_name.empty()) {
    throw TraceError("the trace session's name is empty", "give it a session-name");
  }
  const std::string session = config.lttng_session_name();
  if (session.find('/') != std::string::npos) {
    throw TraceError(fmt::format("trace session name '{}' contains a '/'", session),
                     "the directory that will hold the trace is given by base-path (launch trace: --path)");
  }
  if (session.size() >= LTTNG_NAME_MAX) {
    throw TraceError(fmt::format("trace session name '{}' is longer than {} characters", session, LTTNG_NAME_MAX - 1));
  }
  if (config.events_ust.empty() && config.events_python.empty() && config.events_kernel.empty() &&
      config.syscalls.empty() && config.channels.empty()) {
    throw TraceError(fmt::format("no events enabled for trace session '{}'", session),
                     "name some in events-ust, events-python, events-kernel or syscalls");
  }
  if (config.over_network()) {
    check_relay_daemon(config);
    return;
  }
  std::error_code ignored;
  if (const std::string directory = config.trace_directory();
      !config.append_trace && std::filesystem::exists(directory, ignored)) {
    throw TraceError(
        fmt::format("trace directory {} exists already", directory),
        "set append-trace to true (launch trace: --append-trace) to add to it, or choose another session-name");
  }
  check_writable(config.base_path);
}

void check_writable(const std::string& base_path) {
  std::filesystem::path existing = base_path;
  std::error_code error;
  while (!std::filesystem::exists(existing, error) && existing.has_relative_path()) {
    existing = existing.parent_path();
  }

  std::string reason;
  if (!std::filesystem::is_directory(existing, error)) {
    reason = fmt::format("{} is not a directory", existing.string());
  } else if (faccessat(AT_FDCWD, existing.c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
    reason = fmt::format("{}: {}", existing.string(), std::strerror(errno));
  } else {
    return;
  }
  throw TraceError(fmt::format("cannot write traces to {}: {}", base_path, reason),
                   "choose another base-path, or set ROS_TRACE_DIR");
}

std::uint64_t free_shared_memory() {
  constexpr const char* kFolder = "/dev/shm";
  struct statvfs usage {};
  const int result = statvfs(kFolder, &usage);
  int error = result != 0 ? errno : 0;
  if (error == 0 && (usage.f_flag & ST_RDONLY) != 0) {
    error = EROFS;
  }
  if (error == 0 && faccessat(AT_FDCWD, kFolder, W_OK | X_OK, AT_EACCESS) != 0) {
    error = errno;
  }
  if (error != 0) {
    throw TraceError(
        fmt::format("userspace events need shared memory, but {} cannot be written: {}", kFolder, std::strerror(error)),
        "mount a tmpfs there that all users can write to; containers have one unless it was taken away");
  }
  return std::uint64_t{usage.f_bavail} * usage.f_frsize;
}

}  // namespace tracing
