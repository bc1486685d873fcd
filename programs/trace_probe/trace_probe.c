// SPDX-License-Identifier: Apache-2.0
/* launch-trace-probe: registers with LTTng's session daemon as every traced program does, fires launch_probe:fired
   once, and ends.

   With it the launcher finds out whether a session with certain context fields records anything at all. And it saves
   time at the end of a session: LTTng 2.13 hands the description of the events to its consumer when a traced program
   ends or the session is stopped, and then waits in steps of 200 ms until the consumer has written it. Run while the
   traced nodes are at work, this program has that done early, so that the session stops at once when they have ended.

   `launch-trace-probe measure` fires launch_probe:measured instead, in batches, and prints the processor time that an
   event took in nanoseconds. This is the median of the batches, so batches with an interrupt or a new page don't count.
   If no session records the event, it prints nothing and exits with 1. */
#define LTTNG_UST_TRACEPOINT_CREATE_PROBES
#define LTTNG_UST_TRACEPOINT_DEFINE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "probe_tracepoints.h"

enum { kBatches = 101, kEventsPerBatch = 300, kWarmUpBatches = 20 };

static double thread_nanoseconds(void) {
  struct timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return (double)time.tv_sec * 1e9 + (double)time.tv_nsec;
}

static double batch(void) {
  const double begin = thread_nanoseconds();
  for (long i = 0; i < kEventsPerBatch; ++i) {
    lttng_ust_tracepoint(launch_probe, measured, (const void*)0x1000, (const void*)i);
  }
  return (thread_nanoseconds() - begin) / kEventsPerBatch;
}

static int compare(const void* left, const void* right) {
  const double a = *(const double*)left;
  const double b = *(const double*)right;
  return (a > b) - (a < b);
}

static int measure(void) {
  double took[kBatches];
  if (!lttng_ust_tracepoint_enabled(launch_probe, measured)) {
    return 1;
  }
  for (int i = 0; i < kWarmUpBatches; ++i) {
    batch();
  }
  for (int i = 0; i < kBatches; ++i) {
    took[i] = batch();
  }
  qsort(took, kBatches, sizeof *took, &compare);
  printf("%.1f\n", took[kBatches / 2]);
  return 0;
}

int main(int argc, char** argv) {
  if (argc > 1 && strcmp(argv[1], "measure") == 0) {
    return measure();
  }
  lttng_ust_tracepoint(launch_probe, fired);
  return 0;
}
