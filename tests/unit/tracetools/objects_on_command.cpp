// SPDX-License-Identifier: Apache-2.0
// Does what the lines of standard input say, and answers each with the same line: `make N` and `end N` make and end an
// object, `take N` fires N run-time events, `fork N` makes N processes that end at once.
#include <sys/wait.h>
#include <unistd.h>

#include <cinttypes>
#include <cstdio>
#include <cstring>

#include "tracetools/tracetools.h"

int main() {
  char what[8];
  for (uintptr_t number; std::scanf("%7s %" SCNuPTR, what, &number) == 2;) {
    const auto* const handle = reinterpret_cast<const void*>(number);
    if (std::strcmp(what, "make") == 0) {
      TRACETOOLS_TRACEPOINT(rcl_timer_init, handle, 1);
    } else if (std::strcmp(what, "end") == 0) {
      TRACETOOLS_EXT_TRACEPOINT(rcl_timer_fini, handle);
    } else if (std::strcmp(what, "take") == 0) {
      for (uintptr_t i = 0; i < number; ++i) {
        TRACETOOLS_TRACEPOINT(rcl_take, nullptr);
      }
    } else {
      for (uintptr_t i = 0; i < number; ++i) {
        const pid_t child = fork();
        if (child == 0) {
          _exit(0);
        }
        waitpid(child, nullptr, 0);
      }
    }
    std::printf("%s %" PRIuPTR "\n", what, number);
    std::fflush(stdout);
  }
}
