// SPDX-License-Identifier: Apache-2.0
// The end of a process in which nodes are left: static objects, or those that nobody destroys.
//
// Fast DDS makes static objects while it works, later than the program made its own. So they are destroyed first, and a
// node that is destroyed after them would use them. Therefore all participants that are left are deleted before that,
// by a function that runs at exit(), and other processes hear of their end. Nodes and their endpoints do nothing from
// then on.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <functional>

namespace rmw_fastrtps {

namespace detail {
extern std::atomic<bool> process_ends;
}

// Whether the participants have been deleted. Then no entity of Fast DDS may be used.
inline bool process_ends() noexcept {
  return detail::process_ends.load(std::memory_order_relaxed);
}

// Call it when a participant has been made. Fast DDS has made its static objects by then, so they are destroyed later.
void prepare_end_of_process();

// What is ended with the process unless it is destroyed before. The newest is ended first.
class EndedWithProcess {
 public:
  explicit EndedWithProcess(std::function<void()> end);
  ~EndedWithProcess();
  EndedWithProcess(const EndedWithProcess&) = delete;
  EndedWithProcess& operator=(const EndedWithProcess&) = delete;

  // Does nothing in the child of a fork, which has neither the threads nor the participants of its parent.
  void end() const;

 private:
  std::function<void()> end_;
  pid_t process_;
};

}  // namespace rmw_fastrtps
