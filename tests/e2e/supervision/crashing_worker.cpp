// SPDX-License-Identifier: Apache-2.0
// Crashes in a function of its own while another thread waits in one.
#include <cstdio>
#include <future>
#include <thread>

namespace {

[[gnu::noinline]] int wait_in_another_thread(std::promise<void>& ready, std::promise<int>& never) {
  ready.set_value();
  return never.get_future().get();
}

[[gnu::noinline]] int read_through(const volatile int* pointer) {
  return *pointer;
}

}  // namespace

int main(int argc, char**) {
  std::promise<void> ready;
  std::promise<int> never;
  std::thread other([&] { wait_in_another_thread(ready, never); });
  ready.get_future().wait();
  for (int i = 1; i <= 3; ++i) {
    std::printf("line %d\n", i);
  }
  std::fflush(stdout);
  // An address that no program has mapped.
  return read_through(reinterpret_cast<const volatile int*>(static_cast<unsigned long>(argc) * 0x10));
}
