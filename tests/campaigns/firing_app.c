// SPDX-License-Identifier: Apache-2.0
// Usage: firing_app COUNTS [threads=N] [events=N] [bytes=N] [burst=N] [pause=MICROSECONDS] [crash=MICROSECONDS]
// Fires campaign:even and campaign:odd in N threads, each so many events (0: without end), of so many bytes, and pauses
// after each burst. Ends when all have fired, or on SIGINT and SIGTERM. With `crash` the main thread dies of SIGSEGV
// after this time, whatever the others do. The file COUNTS, shared memory that outlives the program, holds what was
// fired: struct Counts for each thread.
#define LTTNG_UST_TRACEPOINT_CREATE_PROBES
#define LTTNG_UST_TRACEPOINT_DEFINE
#define _GNU_SOURCE
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "firing_app_tracepoints.h"

enum { kMostThreads = 16, kMostProcessors = 64 };

struct Counts {
  uint64_t begun;  // 0: the thread has fired nothing
  uint64_t done;
  struct {
    uint64_t number;  // of the last event that was fired on this processor and finished
    uint64_t time;    // CLOCK_MONOTONIC, before it was fired
  } last[kMostProcessors];
};

static volatile struct Counts* counts;
static volatile sig_atomic_t stopped;
static long threads = 1, events = 0, bytes = 8, burst = 0, pause_us = 0, crash_us = -1;
static char* text;

static void stop(int signal_number) {
  (void)signal_number;
  stopped = 1;
}

static uint64_t now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (uint64_t)time.tv_sec * 1000000000u + (uint64_t)time.tv_nsec;
}

static void wait_for(long microseconds) {
  const struct timespec time = {microseconds / 1000000, microseconds % 1000000 * 1000};
  nanosleep(&time, NULL);
}

static void* fire(void* argument) {
  const int index = (int)(intptr_t)argument;
  volatile struct Counts* own = &counts[index];
  for (uint64_t number = 1; (events == 0 || number <= (uint64_t)events) && !stopped; ++number) {
    const int before = sched_getcpu();
    const uint64_t time = now();
    own->begun = number;
    if (index % 2 == 0) {
      lttng_ust_tracepoint(campaign, even, index, number, text);
    } else {
      lttng_ust_tracepoint(campaign, odd, index, number, text);
    }
    own->done = number;
    if (before == sched_getcpu() && before < kMostProcessors) {
      own->last[before].number = number;
      own->last[before].time = time;
    }
    if (burst != 0 && number % (uint64_t)burst == 0) {
      wait_for(pause_us);
    }
  }
  return NULL;
}

static void read_argument(const char* argument) {
  const struct {
    const char* name;
    long* value;
  } known[] = {{"threads=", &threads}, {"events=", &events},  {"bytes=", &bytes},
               {"burst=", &burst},     {"pause=", &pause_us}, {"crash=", &crash_us}};
  for (size_t i = 0; i < sizeof known / sizeof known[0]; ++i) {
    const size_t length = strlen(known[i].name);
    if (strncmp(argument, known[i].name, length) == 0) {
      *known[i].value = atol(argument + length);
      return;
    }
  }
  fprintf(stderr, "firing_app: unknown argument '%s'\n", argument);
  exit(2);
}

int main(int argc, char** argv) {
  if (argc < 2) {
    return 2;
  }
  for (int i = 2; i < argc; ++i) {
    read_argument(argv[i]);
  }
  if (threads > kMostThreads) {
    return 2;
  }
  const int file = open(argv[1], O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file < 0 || ftruncate(file, kMostThreads * sizeof(struct Counts)) != 0) {
    perror(argv[1]);
    return 2;
  }
  counts = mmap(NULL, kMostThreads * sizeof(struct Counts), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (counts == MAP_FAILED) {
    return 2;
  }
  setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
  signal(SIGINT, stop);
  signal(SIGTERM, stop);
  text = malloc((size_t)bytes + 1);
  memset(text, 'x', (size_t)bytes);
  text[bytes] = '\0';

  pthread_t started[kMostThreads];
  for (long i = 0; i < threads; ++i) {
    pthread_create(&started[i], NULL, fire, (void*)(intptr_t)i);
  }
  if (crash_us >= 0) {
    wait_for(crash_us);
    raise(SIGSEGV);
  }
  for (long i = 0; i < threads; ++i) {
    pthread_join(started[i], NULL);
  }
  return 0;
}
