// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/module/python_interrupt.hpp"

#include <Python.h>
#include <time.h>
#include <unistd.h>

#include <atomic>

namespace launch::python {
namespace {

constexpr time_t kGrace = 1;  // second that Python has to return before it is interrupted

bool is_active = false;
timer_t timer{};

// The handlers need these without a lock.
std::atomic<unsigned long> arrived{0};  // a bit for each signal
std::atomic<bool> was_interrupted{false};
std::atomic<int> signals_after{0};  // the first interrupt
static_assert(std::atomic<unsigned long>::is_always_lock_free);

int timer_signal() {
  return SIGRTMIN + 5;
}

void set_timer(time_t seconds) {
  const itimerspec when{{0, 0}, {seconds, 0}};
  ::timer_settime(timer, 0, &when, nullptr);
}

extern "C" void on_grace_over(int) {
  was_interrupted = true;
  PyErr_SetInterrupt();  // may be called in a signal handler
}

extern "C" void on_request(int signal) {
  arrived |= 1UL << signal;
  if (!was_interrupted) {
    set_timer(kGrace);
  } else if (++signals_after == 1) {
    PyErr_SetInterrupt();
  } else {
    // Code that goes on after two interrupts ends with the launcher. The guardian ends everything else.
    ::signal(signal, SIG_DFL);
    ::raise(signal);
  }
}

// Without SA_RESTART: the signal ends system calls. Python goes on with them unless it is interrupted.
void handle(int signal, void (*handler)(int), struct sigaction* before) {
  struct sigaction action {};
  action.sa_handler = handler;
  ::sigaction(signal, &action, before);
}

}  // namespace

PythonInterrupt::PythonInterrupt() {
  ::sigemptyset(&unblocked_);
  if (is_active) {
    return;
  }
  is_active = outermost_ = true;
  static const bool has_timer = [] {
    sigevent event{};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = timer_signal();
    handle(timer_signal(), on_grace_over, nullptr);
    return ::timer_create(CLOCK_MONOTONIC, &event, &timer) == 0;
  }();
  if (!has_timer) {
    return;
  }
  was_interrupted = false;
  signals_after = 0;
  sigset_t blocked;
  ::pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before_[i]);
    // nohup(1) ignores SIGHUP, and so do we.
    if (::sigismember(&blocked, kSignals[i]) != 1 || before_[i].sa_handler == SIG_IGN) {
      continue;
    }
    handle(kSignals[i], on_request, nullptr);
    ::sigaddset(&unblocked_, kSignals[i]);
  }
  ::pthread_sigmask(SIG_UNBLOCK, &unblocked_, nullptr);
}

PythonInterrupt::~PythonInterrupt() {
  if (!outermost_) {
    return;
  }
  ::pthread_sigmask(SIG_BLOCK, &unblocked_, nullptr);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    if (::sigismember(&unblocked_, kSignals[i]) == 1) {
      ::sigaction(kSignals[i], &before_[i], nullptr);
    }
  }
  is_active = false;
  set_timer(0);
  const unsigned long signals = arrived.exchange(0);
  if (signals == 0) {
    return;
  }
  // The code may have ended before Python raised the interrupt. No later code shall get it.
  if (PyErr_CheckSignals() != 0) {
    PyErr_Clear();
  }
  for (const int signal : kSignals) {
    if ((signals & 1UL << signal) != 0) {
      ::kill(::getpid(), signal);
    }
  }
}

}  // namespace launch::python
