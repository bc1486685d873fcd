// SPDX-License-Identifier: Apache-2.0
// What could be recorded, as `launch trace events` shows it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tracing {

struct TraceableEvent {
  std::string name;
  std::vector<std::string> processes;  // "NAME PID" of those that can fire it
};

// What can be recorded now. Userspace events are known of running programs only.
struct TraceableEvents {
  bool started_daemon = false;
  std::vector<TraceableEvent> userspace;
  std::vector<std::string> kernel;
  std::size_t syscalls = 0;
  std::string why_no_kernel;  // empty when kernel events can be recorded
  std::string kernel_remedy;
  std::vector<std::string> context_fields_ust;
  std::vector<std::string> context_fields_kernel;
};

}  // namespace tracing
