// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/interpreter/python_watch.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <utility>

namespace launch {

namespace {

struct Watch {
  WatchedRun run;
  PythonPlace place;  // of the call
  struct stat own {};
  rlimit memory{};  // of this process, as it was
  std::optional<rlim_t> expression_memory;
  bool has_time_limit = false;  // the call
};

Watch& watched() {
  static auto* const one = new Watch;
  return *one;
}

int limit_signal() {
  return SIGRTMIN + 6;
}

// Calls only what may be called in a signal handler. The handler of SIGABRT writes where Python is.
extern "C" void on_out_of_time(int) {
  if (PythonAtWork* const memory = watched().run.memory; memory != nullptr) {
    memory->cause = PythonAtWork::Cause::kOutOfTime;
    ::prctl(PR_SET_DUMPABLE, 0);  // a core would tell nothing more
    ::raise(SIGABRT);
  }
}

// For this thread, in which all calls are.
timer_t* limit_timer() {
  static timer_t timer{};
  static const bool exists = [] {
    struct sigaction action {};
    action.sa_handler = on_out_of_time;
    action.sa_flags = SA_RESTART;
    ::sigaction(limit_signal(), &action, nullptr);
    sigevent event{};
    event.sigev_notify = SIGEV_THREAD_ID;
    event.sigev_signo = limit_signal();
    event._sigev_un._tid = ::gettid();  // sigev_notify_thread_id, a name that glibc 2.36 does not have
    return ::timer_create(CLOCK_MONOTONIC, &event, &timer) == 0;
  }();
  return exists ? &timer : nullptr;
}

void set_time_limit(std::chrono::seconds limit) {
  if (timer_t* const timer = limit_timer()) {
    const itimerspec when{{0, 0}, {limit.count(), 0}};
    ::timer_settime(*timer, 0, &when, nullptr);
  }
}

// The private memory that this process has, in bytes (/proc/self/statm: the sixth is data and stack, in pages).
std::uint64_t private_memory() {
  std::ifstream file("/proc/self/statm");
  std::array<std::uint64_t, 6> pages{};
  for (std::uint64_t& count : pages) {
    file >> count;
  }
  return pages[5] * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void limit_memory_of_expression(bool limited) {
  Watch& self = watched();
  if (!self.expression_memory) {
    return;
  }
  rlimit limit = self.memory;
  if (limited) {
    limit.rlim_cur = std::min(*self.expression_memory, self.memory.rlim_cur);
  }
  ::setrlimit(RLIMIT_DATA, &limit);
}

void note_call(const PythonPlace& place) {
  Watch& self = watched();
  PythonAtWork& memory = *self.run.memory;
  const bool runs = !place.file.empty();
  const bool is_expression = place.line != 0;
  self.place = place;
  if (runs) {
    ::strncpy(memory.file.data(), place.file.c_str(), memory.file.size() - 1);
  }
  memory.line = place.line;
  memory.column = place.column;
  const std::optional<std::chrono::seconds> limit =
      is_expression ? std::optional(self.run.expression_limit) : self.run.call_limit;
  memory.seconds = static_cast<std::int32_t>(limit.value_or(std::chrono::seconds(0)).count());
  memory.running = runs ? 1 : 0;
  const bool limited = runs && limit;
  if (limited || self.has_time_limit) {
    set_time_limit(limited ? *limit : std::chrono::seconds(0));
  }
  self.has_time_limit = limited;
  limit_memory_of_expression(is_expression);
}

// What this process opens next would take the numbers of standard descriptors that are closed.
void reopen_standard_descriptors() {
  for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number) {
    if (::fcntl(number, F_GETFD) < 0) {
      static_cast<void>(::open("/dev/null", O_RDWR));  // takes the lowest free number
    }
  }
}

bool has_own_descriptor() {
  const Watch& self = watched();
  struct stat now {};
  return ::fstat(self.run.own_descriptor, &now) == 0 && now.st_dev == self.own.st_dev && now.st_ino == self.own.st_ino;
}

}  // namespace

void watch_python_of_a_run(WatchedRun run) {
  Watch& self = watched();
  self.run = std::move(run);
  ::fstat(self.run.own_descriptor, &self.own);
}

void python_has_started(void (*report_deaths)(int descriptor)) {
  Watch& self = watched();
  if (self.run.memory == nullptr || self.run.memory->used != 0) {
    return;
  }
  self.run.memory->used = 1;
  report_deaths(self.run.traces.get());
  ::getrlimit(RLIMIT_DATA, &self.memory);
  self.expression_memory = private_memory() + self.run.expression_memory;
}

void end_of_watched_run() {
  if (PythonAtWork* const memory = watched().run.memory; memory != nullptr) {
    memory->ended = 1;
  }
}

std::optional<std::chrono::seconds> watched_call_limit() {
  return watched().run.call_limit;
}

WatchedCall::WatchedCall(PythonPlace place) : outer_(watched().place) {
  if (watched().run.memory != nullptr) {
    note_call(place);
  }
}

WatchedCall::~WatchedCall() {
  PythonAtWork* const memory = watched().run.memory;
  if (memory == nullptr) {
    return;
  }
  reopen_standard_descriptors();
  if (!has_own_descriptor()) {
    memory->cause = PythonAtWork::Cause::kClosedDescriptors;
    ::_exit(EXIT_FAILURE);
  }
  note_call(outer_);
}

}  // namespace launch
