// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/module/python_failure.hpp"

#include <Python.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <cstdint>
#include <initializer_list>
#include <string>

namespace py = pybind11;

namespace launch::python {

namespace {

constexpr long kTick = 500'000'000;  // nanoseconds
constexpr int kPatience = 2;         // ticks with a pending signal

bool is_active = false;
// Of the handler, which runs in the thread of the blocks only.
volatile sig_atomic_t ticks_with_signal = 0;
volatile sig_atomic_t was_interrupted = 0;

int tick_signal() {
  return SIGRTMIN + 5;
}

extern "C" void on_tick(int);

// With SA_RESTART the tick is hardly noticed. Without it, it ends system calls, and Python looks for interrupts then.
void handle_ticks(int flags) {
  struct sigaction action {};
  action.sa_handler = on_tick;
  action.sa_flags = flags;
  ::sigaction(tick_signal(), &action, nullptr);
}

bool asks_to_end(const sigset_t& signals) {
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM}) {
    if (::sigismember(&signals, signal) == 1) {
      return true;
    }
  }
  return false;
}

// Calls only what may be called in a signal handler.
extern "C" void on_tick(int) {
  sigset_t pending;
  if (::sigpending(&pending) != 0 || !asks_to_end(pending)) {
    ticks_with_signal = 0;
    return;
  }
  ticks_with_signal = ticks_with_signal + 1;
  if (ticks_with_signal >= kPatience && was_interrupted == 0) {
    was_interrupted = 1;
    handle_ticks(0);
    PyErr_SetInterrupt();
  }
}

// Ticks in this thread; nullptr when the kernel has no timer for us.
timer_t* tick_timer() {
  static timer_t timer{};
  static const bool exists = [] {
    sigevent event{};
    event.sigev_notify = SIGEV_THREAD_ID;
    event.sigev_signo = tick_signal();
    event._sigev_un._tid = ::gettid();  // sigev_notify_thread_id, a name that glibc 2.36 does not have
    return ::timer_create(CLOCK_MONOTONIC, &event, &timer) == 0;
  }();
  return exists ? &timer : nullptr;
}

void set_ticks(long nanoseconds) {
  if (timer_t* const timer = tick_timer()) {
    const itimerspec when{{0, nanoseconds}, {0, nanoseconds}};
    ::timer_settime(*timer, 0, &when, nullptr);
  }
}

}  // namespace

PythonInterrupt::PythonInterrupt() : outermost_(!is_active) {
  if (outermost_) {
    is_active = true;
    ticks_with_signal = 0;
    was_interrupted = 0;
    handle_ticks(SA_RESTART);
    set_ticks(kTick);
  }
}

PythonInterrupt::~PythonInterrupt() {
  if (!outermost_) {
    return;
  }
  is_active = false;
  set_ticks(0);
  // The code may have ended before Python raised the interrupt. No later code shall get it.
  if (was_interrupted != 0 && PyErr_CheckSignals() != 0) {
    PyErr_Clear();
  }
}

bool& shows_tracebacks() {
  static bool shows = false;
  return shows;
}

void throw_failure(py::error_already_set& error) {
  std::string message;
  std::string help;
  std::string traceback;
  Place where;
  std::exception_ptr cause;
  try {
    const py::object trace = error.trace() ? py::object(error.trace()) : py::none();
    const py::tuple explained =
        py::module_::import("launch._explain").attr("explain")(error.value(), trace, shows_tracebacks());
    message = explained[0].cast<std::string>();
    where = read_place(explained[1]);
    help = explained[2].cast<std::string>();
    traceback = explained[3].cast<std::string>();
    if (!explained[4].is_none()) {
      cause = host_failure(explained[4].cast<std::size_t>());
    }
  } catch (const std::exception& failure) {
    message = std::string("a Python error that can't be explained: ") + error.what();
  }
  throw Error(message, std::move(where), std::move(help), std::move(traceback), std::move(cause));
}

Place read_place(const py::handle& place) {
  if (place.is_none()) {
    return {};
  }
  const auto parts = place.cast<py::tuple>();
  return {parts[0].cast<std::string>(), parts[1].cast<std::uint32_t>(), parts[2].cast<std::uint32_t>(),
          parts[3].cast<std::uint32_t>()};
}

}  // namespace launch::python
