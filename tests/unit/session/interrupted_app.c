// SPDX-License-Identifier: Apache-2.0
// Usage: interrupted_app COUNT die|wait
// Fires COUNT events ros2:rclcpp_take, then one more within which it dies of SIGKILL, or says "within", waits for a
// line on stdin, and goes on.
#define LTTNG_UST_TRACEPOINT_CREATE_PROBES
#define LTTNG_UST_TRACEPOINT_DEFINE
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const void* within_event(const void* message);

#include "interrupted_app_tracepoints.h"

static int dies;

static const void* within_event(const void* message) {
  if (message != NULL) {
    return message;
  }
  if (dies) {
    raise(SIGKILL);
  }
  puts("within");
  fflush(stdout);
  getchar();
  return message;
}

int main(int argc, char** argv) {
  if (argc < 3) {
    return 2;
  }
  dies = strcmp(argv[2], "die") == 0;
  for (long i = atol(argv[1]); i > 0; --i) {
    lttng_ust_tracepoint(ros2, rclcpp_take, (const void*)i);
  }
  lttng_ust_tracepoint(ros2, rclcpp_take, NULL);
  return 0;
}
