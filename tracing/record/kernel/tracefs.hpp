// SPDX-License-Identifier: Apache-2.0
// An instance of the kernel's own tracer. Its ring buffers, enabled events and clock are separate from all others
// (Documentation/trace/ftrace.rst, "Instances").
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tracing/record/kernel/event_format.hpp"

namespace tracing::kernel {

// what() is one line; remedy() says what to do and may be empty.
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

  // Mounts tracefs in a mount namespace of this process if it isn't mounted yet. All functions throw KernelTraceError.
  explicit TracefsInstance(const std::string& name);
  ~TracefsInstance();  // removes the instance
  TracefsInstance(const TracefsInstance&) = delete;
  TracefsInstance& operator=(const TracefsInstance&) = delete;

  // Enables events by LTTng's names for them (sched_switch, kmem_mm_page_alloc); * matches any text. The filter is in
  // the kernel's language. This function and the next one throw UnknownNameError when there is no such event.
  void enable_event(const std::string& pattern, const std::string& filter);
  // Enables a system call: its entry and its exit.
  void enable_syscall(const std::string& name);
  // Enables one event more, such as "task/task_newtask". formats() does not include it unless enable_event() asks for
  // it, too.
  EventFormat watch_event(const std::string& path);
  // The enabled events, each once.
  std::vector<EventFormat> formats() const;

  // What these processes, numbers or "self", do and those that they start is not recorded. A switch between one of
  // their threads and another thread still is, so that the processor's threads stay known without a gap. Does nothing
  // in a container, where the kernel's numbers of threads are others, and before Linux 5.7.
  void leave_out(const std::vector<std::string>& processes);

  // From now on full buffers overwrite the oldest events.
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
