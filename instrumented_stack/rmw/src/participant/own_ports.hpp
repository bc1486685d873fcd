// SPDX-License-Identifier: Apache-2.0
// Ports in shared memory that this process reads, and that others may take away.
//
// Whoever opens a port of Fast DDS that it finds unhealthy, or not ready yet, removes its file and makes a new one. A
// lock is to keep two processes from doing so at a time, but it is removed together with the port, and by whoever has
// waited two seconds for it. So a process may remove the port that its reader has just made. The reader goes on reading
// memory that has no name any more, and everybody else writes into the new port, which nobody reads. Fast DDS never
// notices. So this class looks, whenever something has come another way.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>

namespace rmw_fastrtps {

// Thread safe.
class OwnPorts {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  // Fast DDS itself makes a port anew that was declared unhealthy. That takes a third of a second, more on a busy
  // machine.
  static constexpr std::chrono::milliseconds kPatience{1000};

  // The process reads this port. `close` and `open` are called one after the other, to open it again.
  void opened(std::uint32_t port, std::function<void()> close, std::function<void()> open);
  // It does not read it any more. Waits while the port is being opened again.
  void closed(std::uint32_t port);
  // It reads none any more.
  void all_closed();

  // Opens those ports again that have had another file for a while, at most once in kPatience. Must not be called by a
  // thread that reads a port, because `close` waits for its end.
  void check(TimePoint now);

 private:
  struct Port {
    std::function<void()> close;
    std::function<void()> open;
    std::uint64_t file = 0;  // that this process reads; 0: none
    bool is_in_doubt = false;
  };

  std::mutex mutex_;
  std::map<std::uint32_t, Port> ports_;
  TimePoint next_{};
};

}  // namespace rmw_fastrtps
