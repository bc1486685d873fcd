// SPDX-License-Identifier: Apache-2.0
// A thread that the child of a fork does not wait for.
#pragma once

#include <unistd.h>

#include <thread>
#include <utility>

namespace rcutils {

// A thread that is joined only by the process that has started it. The child of a fork has none of its parent's
// threads, but their objects, which are destroyed when it calls exit(). Later releases of glibc (2.43) would wait for
// ever there.
class JoinedThread {
 public:
  JoinedThread() = default;
  template <typename Function>
  explicit JoinedThread(Function function) : thread_(std::move(function)), process_(getpid()) {}

  bool joinable() const { return thread_.joinable(); }
  std::thread::id get_id() const { return thread_.get_id(); }
  bool is_of_this_process() const { return process_ == getpid(); }

  void join() {
    if (is_of_this_process()) {
      thread_.join();
    } else {
      new std::thread(std::move(thread_));  // never destroyed: a thread that can be joined must not be
    }
  }

 private:
  std::thread thread_;
  pid_t process_ = 0;
};

}  // namespace rcutils
