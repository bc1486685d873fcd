#include "tracing/session/setup_checks.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <lttng/lttng.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "tracing/session/channels.hpp"
#include "tracing/session/tracer.hpp"

namespace tracing {
namespace {

constexpr const char* kParanoidFile = "/proc/sys/kernel/perf_event_paranoid";
constexpr int kParanoidLimit = 2;  // perf_event_open(2): from here on only privileged users may count kernel events

}  // namespace

void check_config(const TraceConfig& config) {
  if (config.session_name.empty()) throw TraceError("the trace session's name is empty", "give it a session-name");
  const std::string session = config.lttng_session_name();
  if (session.find('/') != std::string::npos) {
    throw TraceError(fmt::format("trace session name '{}' contains a '/'", session),
                     "the directory that will hold the trace is given by base-path");
  }
  if (session.size() >= LTTNG_NAME_MAX) {
    throw TraceError(fmt::format("trace session name '{}' is longer than {} characters", session, LTTNG_NAME_MAX - 1));
  }
  if (config.events_ust.empty() && config.events_kernel.empty() && config.syscalls.empty()) {
    throw TraceError(fmt::format("no events enabled for trace session '{}'", session),
                     "name some in events-ust, events-kernel or syscalls");
  }
  std::error_code ignored;
  if (const std::string directory = config.trace_directory();
      !config.append_trace && std::filesystem::exists(directory, ignored)) {
    throw TraceError(fmt::format("trace directory {} exists already", directory),
                     "set append-trace to true to add to it, or choose another session-name");
  }
  check_writable(config.base_path);
}

void check_writable(const std::string& base_path) {
  std::filesystem::path existing = base_path;
  std::error_code error;
  while (!std::filesystem::exists(existing, error) && existing.has_relative_path()) existing = existing.parent_path();

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

void check_kernel_tracer() {
  const DomainHandle handle = domain_handle("", LTTNG_DOMAIN_KERNEL);
  lttng_event* tracepoints = nullptr;
  const int count = lttng_list_tracepoints(handle.get(), &tracepoints);
  std::free(tracepoints);
  if (count >= 0) return;
  throw TraceError(fmt::format("kernel events cannot be recorded: {}", lttng_strerror(count)),
                   "install the kernel tracer (sudo apt-get install lttng-modules-dkms) and run as root or as a member "
                   "of the group `tracing`; or trace without events-kernel and syscalls");
}

std::vector<std::string> perf_warnings(const std::vector<std::string>& context_fields_ust) {
  const bool wanted = std::any_of(context_fields_ust.begin(), context_fields_ust.end(),
                                  [](const std::string& name) { return name.starts_with("perf:thread:"); });
  int level = 0;
  if (!wanted || !(std::ifstream(kParanoidFile) >> level) || level < kParanoidLimit) return {};
  return {fmt::format("perf:thread: context fields with {} at {}: the trace may be empty; lower it to 1", kParanoidFile,
                      level)};
}

}  // namespace tracing
