// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/kernel/tracefs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "tracing/record/kernel/pid_namespace.hpp"

namespace tracing::kernel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMountPoint = "/sys/kernel/tracing";
constexpr const char* kOldMountPoint = "/sys/kernel/debug/tracing";
constexpr const char* kPrivilege = "run as root: only root may use the kernel's tracer";
constexpr const char* kReadAtPercent = "10";  // a reader is woken when this part of the buffer is filled

bool is_tracefs(const fs::path& directory) {
  std::error_code ignored;
  return fs::exists(directory / "instances", ignored);
}

fs::path find_tracefs() {
  for (const char* place : {kMountPoint, kOldMountPoint}) {
    if (is_tracefs(place)) {
      return place;
    }
  }
  if (geteuid() != 0) {
    throw KernelTraceError(fmt::format("{} cannot be read", kMountPoint), kPrivilege);
  }
  // In a mount namespace of our own, so that nothing of the system changes.
  if (unshare(CLONE_NEWNS) != 0 || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount("tracefs", kMountPoint, "tracefs", 0, nullptr) != 0) {
    throw KernelTraceError(fmt::format("tracefs cannot be mounted at {}: {}", kMountPoint, std::strerror(errno)),
                           "in a container mount it from the host: --volume /sys/kernel/tracing:/sys/kernel/tracing");
  }
  return kMountPoint;
}

std::string read_file(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// `how` is O_TRUNC or O_APPEND. std::ofstream wants to know where the end is, which tracefs does not tell.
void write_to(const fs::path& path, int how, const std::string& text) {
  const int fd = ::open(path.c_str(), O_WRONLY | how | O_CLOEXEC);
  const bool written = fd >= 0 && ::write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int error = errno;
  if (fd >= 0) {
    ::close(fd);
  }
  if (!written) {
    throw KernelTraceError(fmt::format("cannot write '{}' to {}: {}", text, path.string(), std::strerror(error)),
                           error == EACCES || error == EPERM ? kPrivilege : "");
  }
}

std::vector<std::string> threads_of(const std::vector<std::string>& processes) {
  std::vector<std::string> threads;
  for (const std::string& process : processes) {
    std::error_code gone;
    for (const fs::directory_entry& thread : fs::directory_iterator(fmt::format("/proc/{}/task", process), gone)) {
      threads.push_back(thread.path().filename());
    }
  }
  return threads;
}

}  // namespace

TracefsInstance::TracefsInstance(const std::string& name) {
  const fs::path directory = find_tracefs() / "instances" / name;
  ::rmdir(directory.c_str());  // left by a recorder that was killed; an instance in use stays
  std::error_code error;
  if (!fs::create_directory(directory, error)) {
    throw KernelTraceError(
        fmt::format("cannot create {}: {}", directory.string(), error ? error.message() : "it exists already"),
        error == std::errc::permission_denied
            ? kPrivilege
            : "another session of this name records kernel events: choose another session-name");
  }
  directory_ = directory;
  try {
    write("tracing_on", "0");
    write("trace_clock", "mono");  // CLOCK_MONOTONIC, the clock of LTTng
    write("buffer_size_kb", std::to_string(kBufferBytes / 1024));
    std::ofstream(directory_ / "buffer_percent") << kReadAtPercent;  // since Linux 5.0
  } catch (const KernelTraceError&) {
    fs::remove(directory_, error);
    throw;
  }
}

TracefsInstance::~TracefsInstance() {
  // Only rmdir(2) removes an instance, including everything in it that looks like a file.
  ::rmdir(directory_.c_str());
}

void TracefsInstance::enable_event(const std::string& pattern, const std::string& filter) {
  std::size_t found = 0;
  for (const fs::directory_entry& group : fs::directory_iterator(directory_ / "events")) {
    const std::string group_name = group.path().filename();
    if (!group.is_directory() || group_name == "syscalls" || group_name == "ftrace") {
      continue;
    }
    for (const fs::directory_entry& event : fs::directory_iterator(group)) {
      if (!event.is_directory()) {
        continue;
      }
      const std::string name = event.path().filename();
      // LTTng puts the group before some names.
      const auto is_meant = [&pattern](const std::string& called) {
        return fnmatch(pattern.c_str(), called.c_str(), 0) == 0;
      };
      if (!is_meant(name) && !is_meant(lttng_name(name)) && !is_meant(group_name + "_" + name)) {
        continue;
      }
      enable(event.path(), filter);
      ++found;
    }
  }
  if (found == 0) {
    throw UnknownNameError(fmt::format("the kernel has no event '{}'", pattern),
                           fmt::format("{}/available_events lists them", kMountPoint));
  }
}

void TracefsInstance::enable_syscall(const std::string& name) {
  const fs::path folder = directory_ / "events" / "syscalls";
  std::size_t found = 0;
  std::error_code none;
  for (const fs::directory_entry& event : fs::directory_iterator(folder, none)) {
    const std::string entry = event.path().filename();
    for (const char* kind : {"sys_enter_", "sys_exit_"}) {
      if (!entry.starts_with(kind) || fnmatch(name.c_str(), entry.c_str() + std::strlen(kind), 0) != 0) {
        continue;
      }
      enable(event.path(), {});
      ++found;
    }
  }
  if (found == 0) {
    throw UnknownNameError(
        fmt::format("the kernel has no system call '{}' to trace", name),
        fs::exists(folder) ? "name it without 'sys_', as in openat" : "it was built without CONFIG_FTRACE_SYSCALLS");
  }
}

void TracefsInstance::enable(const fs::path& event, const std::string& filter) {
  if (std::find(enabled_.begin(), enabled_.end(), event) != enabled_.end()) {
    return;
  }
  if (!filter.empty()) {
    try {
      write(event / "filter", filter);
    } catch (const KernelTraceError&) {
      throw KernelTraceError(
          fmt::format("the kernel does not understand the filter of event '{}': {}", event.filename().string(), filter),
          "its names and operators are in the event's file `format` and in events.rst of the kernel");
    }
  }
  write(event / "enable", "1");
  enabled_.push_back(event);
}

EventFormat TracefsInstance::watch_event(const std::string& path) {
  write(fs::path("events") / path / "enable", "1");
  return parse_event_format(read_file(directory_ / "events" / path / "format"));
}

std::vector<EventFormat> TracefsInstance::formats() const {
  std::vector<EventFormat> formats;
  for (const fs::path& event : enabled_) {
    formats.push_back(parse_event_format(read_file(event / "format")));
  }
  return formats;
}

void TracefsInstance::leave_out(const std::vector<std::string>& processes) {
  constexpr const char* kFile = "set_event_notrace_pid";
  std::error_code error;
  if (!is_in_first_pid_namespace() || !fs::exists(directory_ / kFile, error)) {
    return;
  }
  write("options/event-fork", "1");
  // The second time for threads that began meanwhile, before their starter was left out.
  for (int i = 0; i < 2; ++i) {
    write_to(directory_ / kFile, O_APPEND, fmt::format("{}", fmt::join(threads_of(processes), " ")));
  }
}

void TracefsInstance::keep_newest() {
  write("options/overwrite", "1");
}

void TracefsInstance::start() {
  write("tracing_on", "1");
}

void TracefsInstance::stop() {
  write("tracing_on", "0");
}

std::vector<std::pair<unsigned, fs::path>> TracefsInstance::ring_buffers() const {
  std::vector<std::pair<unsigned, fs::path>> buffers;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory_ / "per_cpu")) {
    const std::string name = entry.path().filename();  // cpu0
    buffers.emplace_back(static_cast<unsigned>(std::stoul(name.substr(3))), entry.path() / "trace_pipe_raw");
  }
  return buffers;
}

void TracefsInstance::write(const fs::path& file, const std::string& text) const {
  write_to(directory_ / file, O_TRUNC, text);
}

}  // namespace tracing::kernel
