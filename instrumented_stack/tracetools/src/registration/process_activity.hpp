// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdint>

namespace tracetools {

// Whether a process does something, as the kernel sees it (proc(5)): its threads run, wait for a processor or a disk,
// or have run since the last look. The calling thread does not count, and the children of the process do.
class ProcessActivity {
 public:
  ProcessActivity() = default;
  // Looks at the process now. A process that cannot be seen does something.
  explicit ProcessActivity(pid_t process);

  void add(const ProcessActivity& other);
  bool is_stopped() const { return stopped_; }
  bool is_busy_since(const ProcessActivity& before) const { return busy_ || switches_ != before.switches_; }

 private:
  void look_at_thread(pid_t process, pid_t thread);
  void look_at_children(pid_t process, pid_t thread);
  void look_at(pid_t process);

  bool stopped_ = false;        // the process itself: a signal or a debugger stops it
  bool busy_ = false;           // a thread runs, or waits for a processor or a disk
  std::uint64_t switches_ = 0;  // times that threads have got or given up a processor
};

}  // namespace tracetools
