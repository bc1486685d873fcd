// SPDX-License-Identifier: Apache-2.0
// What QEMU lacks when it runs programs for another processor: a child that shares the memory and the descriptors of
// its parent. Its vfork() copies the memory, so a child can't tell its parent why it did not start a program. And what
// it makes up: /proc/self/stat, without use of memory or processors. It shows no network devices.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

namespace test_support {

inline bool vfork_shares_memory() {
  static volatile bool written = false;
  const pid_t pid = ::vfork();
  if (pid == 0) {
    written = true;
    ::_exit(0);
  }
  ::waitpid(pid, nullptr, 0);
  return written;
}

}  // namespace test_support

#define NEEDS_WHAT_QEMU_LACKS(why)            \
  if (!test_support::vfork_shares_memory()) { \
    GTEST_SKIP() << "skipped, because " why;  \
  }                                           \
  static_assert(true)

#define NEEDS_VFORK() NEEDS_WHAT_QEMU_LACKS("vfork() copies the memory here, as under QEMU")
#define NEEDS_PROC_SELF() NEEDS_WHAT_QEMU_LACKS("/proc/self/stat is made up here, as by QEMU")
#define NEEDS_ITS_OWN_TRACER() NEEDS_WHAT_QEMU_LACKS("a tracer that runs under QEMU ends sessions late or never")
#define NEEDS_NETWORK_DEVICES() NEEDS_WHAT_QEMU_LACKS("no network devices can be seen here, as under QEMU")
