// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/spawn/stopped_threads.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

namespace launch {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLongEnough(30'000);

// A child with two threads that never end.
class Child {
 public:
  Child() : pid_(::fork()) {
    if (pid_ == 0) {
      std::thread([] {
        for (;;) {
          ::pause();
        }
      }).detach();
      for (;;) {
        ::pause();
      }
    }
  }
  ~Child() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_;
};

TEST(StoppedThreads, AreAwaited) {
  const Child first;
  const Child second;
  ::kill(first.pid(), SIGSTOP);
  ::kill(second.pid(), SIGSTOP);
  EXPECT_TRUE(wait_until_stopped({first.pid(), second.pid()}, kLongEnough));
}

TEST(StoppedThreads, AreNotAwaitedForEver) {
  const Child stopped;
  const Child running;
  ::kill(stopped.pid(), SIGSTOP);
  EXPECT_FALSE(wait_until_stopped({stopped.pid(), running.pid()}, milliseconds(20)));
}

TEST(StoppedThreads, AProcessThatHasEndedCounts) {
  const Child ended;
  ::kill(ended.pid(), SIGKILL);
  EXPECT_TRUE(wait_until_stopped({ended.pid()}, kLongEnough));
  EXPECT_TRUE(wait_until_stopped({}, milliseconds(0)));
}

}  // namespace
}  // namespace launch
