// SPDX-License-Identifier: Apache-2.0
// Fires one ros2:rcl_init. Then each of 100 threads fires 1000 ros2:rcl_take, first all threads at once, and again one
// thread after the other. Then the child of a fork fires seven ros2:rclcpp_take.
#include <sys/wait.h>
#include <unistd.h>

#include <barrier>
#include <thread>
#include <vector>

#include "tracetools/tracetools.h"

namespace {

constexpr int kThreads = 100;

void take_messages() {
  for (int i = 0; i < 1000; ++i) {
    TRACETOOLS_TRACEPOINT(rcl_take, nullptr);
  }
}

}  // namespace

int main() {
  TRACETOOLS_TRACEPOINT(rcl_init, nullptr);
  std::barrier all_fire(kThreads);
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&all_fire] {
      all_fire.arrive_and_wait();
      take_messages();
      all_fire.arrive_and_wait();
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (int i = 0; i < kThreads; ++i) {
    std::thread(take_messages).join();
  }
  const pid_t child = fork();
  if (child == 0) {
    for (int i = 0; i < 7; ++i) {
      TRACETOOLS_TRACEPOINT(rclcpp_take, nullptr);
    }
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}
