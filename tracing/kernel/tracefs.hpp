// SPDX-License-Identifier: Apache-2.0
// An instance of the kernel's own tracer: ring buffers, enabled events and a clock apart from everybody else's
// (Documentation/trace/ftrace.rst, "Instances").
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tracing/kernel/event_format.hpp"

namespace tracing::kernel {

// what() is one line; remedy() says what to do, may be empty.
class KernelTraceError : public std::runtime_error {
 public:
  explicit KernelTraceError(const std::string& what, std::string remedy = {})
      : std::runtime_error(what), remedy_(std::move(remedy)) {}
  const std::string& remedy() const { return remedy_; }

 private:
  std::string remedy_;
};

// The kernel has no event or system call of this name.
class UnknownNameError : public KernelTraceError {
  using KernelTraceError::KernelTraceError;
};

class TracefsInstance {
 public:
  static constexpr std::size_t kBufferBytes = std::size_t{4} << 20;  // for each processor

  // Mounts tracefs in a mount namespace of this process where it isn't mounted. All throw KernelTraceError.
  explicit TracefsInstance(const std::string& name);
  ~TracefsInstance();  // removes it
  TracefsInstance(const TracefsInstance&) = delete;
  TracefsInstance& operator=(const TracefsInstance&) = delete;

  // Events by name as LTTng names them (sched_switch, kmem_mm_page_alloc); * matches any text. A filter is the
  // kernel's. This and the next throw UnknownNameError when there is none.
  void enable_event(const std::string& pattern, const std::string& filter);
  // A system call: its entry and its exit.
  void enable_syscall(const std::string& name);
  // One event more, "task/task_newtask", which formats() does not name unless it is asked for by name, too.
  EventFormat watch_event(const std::string& path);
  // What has been enabled, each once.
  std::vector<EventFormat> formats() const;

  // When the buffers are full the oldest events are overwritten.
  void keep_newest();

  void start();
  void stop();

  // The file that gives the ring buffer of each processor, page after page.
  std::vector<std::pair<unsigned, std::filesystem::path>> ring_buffers() const;

 private:
  void enable(const std::filesystem::path& event, const std::string& filter);
  void write(const std::filesystem::path& file, const std::string& text) const;

  std::filesystem::path directory_;
  std::vector<std::filesystem::path> enabled_;
};

}  // namespace tracing::kernel
