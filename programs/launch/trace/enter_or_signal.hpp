// SPDX-License-Identifier: Apache-2.0
// Waits for Enter on stdin or for a signal to end, whichever comes first.
#pragma once

#include <signal.h>

namespace tracing {

// While an object exists, SIGINT and SIGTERM of this thread do not end the process: they are kept until wait() or
// take_signal() asks for them. Make it before the program starts threads.
class EnterOrSignal {
 public:
  enum class Answer { kEnter, kInputEnded, kSignal };

  EnterOrSignal();
  ~EnterOrSignal();
  EnterOrSignal(const EnterOrSignal&) = delete;
  EnterOrSignal& operator=(const EnterOrSignal&) = delete;

  // Takes one line of stdin and no more, or one signal.
  Answer wait();

  // Takes one signal if one has come. Does not block.
  bool take_signal();

 private:
  sigset_t previous_mask_{};
  int signals_ = -1;
};

}  // namespace tracing
