// SPDX-License-Identifier: Apache-2.0
/// Waits for a session daemon, so that a process that nobody can trace does without lttng-ust: it starts 3 ms sooner,
/// and saves two threads and a megabyte.
#pragma once

#include <array>
#include <optional>

namespace tracetools {

/// What LTTng's session daemons wake processes with: that of root, and that of the user. Each has a file in /dev/shm.
/// Its first number is 1 while the daemon runs, and a daemon that starts wakes all who wait for the number to change.
class DaemonArrival {
 public:
  /// Nothing if a session daemon may be there already, or if this machine has no way to wait for one.
  static std::optional<DaemonArrival> awaited() noexcept;

  /// Returns true when a session daemon has started, and false if it is impossible to wait, because /dev/shm is full.
  bool wait() const noexcept;

 private:
  explicit DaemonArrival(const std::array<const void*, 2>& numbers) : numbers_(numbers) {}

  std::array<const void*, 2> numbers_;  // mapped for the life of the process
};

}  // namespace tracetools
