// SPDX-License-Identifier: Apache-2.0
// Three threads publish and take a message each millisecond, until the end of input: the events of a message's way.
#include <chrono>
#include <cstdio>
#include <stop_token>
#include <thread>
#include <vector>

#include "tracetools/tracetools.h"

namespace {

void exchange_message(const void* message) {
  TRACETOOLS_TRACEPOINT(rclcpp_publish, nullptr, message);
  TRACETOOLS_TRACEPOINT(rcl_publish, nullptr, message);
  TRACETOOLS_TRACEPOINT(rmw_publish, nullptr, message, 1);
  TRACETOOLS_TRACEPOINT(rclcpp_executor_get_next_ready);
  TRACETOOLS_TRACEPOINT(rclcpp_executor_execute, nullptr);
  TRACETOOLS_TRACEPOINT(rmw_take, nullptr, message, 1, true);
  TRACETOOLS_TRACEPOINT(rcl_take, message);
  TRACETOOLS_TRACEPOINT(rclcpp_take, message);
  TRACETOOLS_TRACEPOINT(callback_start, nullptr, false);
}

}  // namespace

int main() {
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < 3; ++thread) {
    threads.emplace_back([](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        exchange_message(&stop);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
  }
  std::puts("ready");
  std::fflush(stdout);
  while (std::getchar() != EOF) {
  }
}
