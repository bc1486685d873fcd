// SPDX-License-Identifier: Apache-2.0
// pthread_mutex_clocklock() and pthread_cond_clockwait() for ThreadSanitizer. GCC 12's does not know these two
// functions, which std::timed_mutex and std::condition_variable use: it misses that the mutex was locked, or given up
// while waiting, and reports races that are none. These here call the functions with the wall clock, which it knows.
#define _GNU_SOURCE
#include <errno.h>
#include <pthread.h>
#include <time.h>

static const long kNanosecondsPerSecond = 1000000000;

// When the wall clock will show what `clock` shows at `deadline`, if neither is set meanwhile.
static struct timespec on_wall_clock(clockid_t clock, const struct timespec* deadline) {
  struct timespec here, wall;
  clock_gettime(clock, &here);
  clock_gettime(CLOCK_REALTIME, &wall);
  wall.tv_sec += deadline->tv_sec - here.tv_sec;
  wall.tv_nsec += deadline->tv_nsec - here.tv_nsec;
  if (wall.tv_nsec < 0) {
    wall.tv_nsec += kNanosecondsPerSecond;
    --wall.tv_sec;
  } else if (wall.tv_nsec >= kNanosecondsPerSecond) {
    wall.tv_nsec -= kNanosecondsPerSecond;
    ++wall.tv_sec;
  }
  if (wall.tv_sec < 0) {
    wall = (struct timespec){0, 0};  // long ago
  }
  return wall;
}

int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock, const struct timespec* deadline) {
  const struct timespec wall = on_wall_clock(clock, deadline);
  return pthread_mutex_timedlock(mutex, &wall);
}

int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                           const struct timespec* deadline) {
  const struct timespec wall = on_wall_clock(clock, deadline);
  return pthread_cond_timedwait(condition, mutex, &wall);
}
