// SPDX-License-Identifier: Apache-2.0
// Four threads make and end objects until the end of input. Then the objects 0x1 and 0x2 live, and nothing happens
// until a signal ends the process. No handle is used twice.
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>
#include <vector>

#include "tracetools/tracetools.h"

namespace {

const void* at(uintptr_t address) {
  return reinterpret_cast<const void*>(address);
}

}  // namespace

int main() {
  TRACETOOLS_TRACEPOINT(rcl_timer_init, at(0x1), 1);
  std::atomic<bool> stop = false;
  std::vector<std::thread> threads;
  for (uintptr_t thread = 1; thread <= 4; ++thread) {
    threads.emplace_back([&stop, thread] {
      for (uintptr_t address = thread << 32; !stop; ++address) {
        TRACETOOLS_TRACEPOINT(rcl_timer_init, at(address), 3);
        TRACETOOLS_EXT_TRACEPOINT(rcl_timer_fini, at(address));
        // This is slow enough for the sub-buffers of a default session.
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
  }
  std::puts("ready");
  std::fflush(stdout);
  while (std::getchar() != EOF) {
  }
  stop = true;
  for (std::thread& thread : threads) {
    thread.join();
  }
  TRACETOOLS_TRACEPOINT(rcl_timer_init, at(0x2), 2);
  std::puts("rest");
  std::fflush(stdout);
  pause();
}
