// SPDX-License-Identifier: Apache-2.0
// Usage: traced_app COUNT BYTES [abort]
// Fires one ros2:rcl_init and COUNT events ros2:rclcpp_callback_register with a symbol of BYTES characters and says
// "fired". For every line on stdin it fires COUNT events more and says so again; it ends when stdin does. With `abort`
// it dies of SIGABRT instead.
#define LTTNG_UST_TRACEPOINT_CREATE_PROBES
#define LTTNG_UST_TRACEPOINT_DEFINE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "traced_app_tracepoints.h"

static void fire(long count, const char* symbol) {
  for (long i = 1; i <= count; ++i) {
    lttng_ust_tracepoint(ros2, rclcpp_callback_register, (const void*)i, symbol);
  }
  puts("fired");
  fflush(stdout);
}

int main(int argc, char** argv) {
  if (argc < 3) {
    return 2;
  }
  const long count = atol(argv[1]);
  const size_t bytes = (size_t)atol(argv[2]);
  char* symbol = malloc(bytes + 1);
  memset(symbol, 'x', bytes);
  symbol[bytes] = '\0';

  lttng_ust_tracepoint(ros2, rcl_init, (const void*)symbol, "1.0.0");
  fire(count, symbol);
  if (argc > 3) {
    abort();
  }
  char line[16];
  while (fgets(line, sizeof line, stdin) != NULL) {
    fire(count, symbol);
  }
  free(symbol);
  return 0;
}
