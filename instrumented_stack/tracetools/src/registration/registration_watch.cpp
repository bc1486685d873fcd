// SPDX-License-Identifier: Apache-2.0
#include "registration/registration_watch.hpp"

#include <errno.h>
#include <signal.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <cstdlib>
#include <vector>

#include "registration/daemon_connection.hpp"
#include "registration/process_activity.hpp"

namespace tracetools {
namespace {

constexpr const char* kLttngVariable = "LTTNG_UST_REGISTER_TIMEOUT";
constexpr const char* kVariable = "TRACETOOLS_REGISTER_TIMEOUT";
constexpr int kBetweenLooks = 100;  // ms
// A daemon that does nothing for so many looks does not answer any more: less than a second together.
constexpr int kLooksWithoutActivity = 7;
constexpr int kLooksStopped = 3;

}  // namespace

RegistrationWatch::RegistrationWatch() {
  const char* const timeout = std::getenv(kVariable);
  if (timeout == nullptr || std::getenv(kLttngVariable) != nullptr) {
    return;
  }
  sem_init(&over_, 0, 0);
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  watching_ = pthread_create(&thread_, nullptr, &watch, this) == 0;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (watching_) {
    setenv(kLttngVariable, timeout, 1);
  }
}

RegistrationWatch::~RegistrationWatch() {
  if (!watching_) {
    return;
  }
  sem_post(&over_);
  pthread_join(thread_, nullptr);
  sem_destroy(&over_);
  unsetenv(kLttngVariable);  // it is not for the programs that this one starts
  for (const DaemonConnection& connection : daemon_connections()) {
    connection.use_default_timeout();
  }
}

bool RegistrationWatch::is_over(int milliseconds) {
  timespec until{};
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += milliseconds * 1'000'000L;
  until.tv_sec += until.tv_nsec / 1'000'000'000;
  until.tv_nsec %= 1'000'000'000;
  int result = 0;
  do {
    result = sem_timedwait(&over_, &until);
  } while (result != 0 && errno == EINTR);
  return result == 0;
}

// This thread loads nothing and takes no lock of the dynamic linker, which the loading thread holds.
void* RegistrationWatch::watch(void* self) {
  auto& watch = *static_cast<RegistrationWatch*>(self);
  int looks_without_activity = 0;
  int looks_stopped = 0;
  ProcessActivity before;
  while (!watch.is_over(kBetweenLooks)) {
    const std::vector<DaemonConnection> connections = daemon_connections();
    if (connections.empty()) {
      continue;
    }
    ProcessActivity now(getpid());
    bool stopped = false;
    for (const DaemonConnection& connection : connections) {
      const ProcessActivity daemon(connection.daemon());
      stopped = stopped || daemon.is_stopped();
      now.add(daemon);
    }
    looks_stopped = stopped ? looks_stopped + 1 : 0;
    looks_without_activity = now.is_busy_since(before) ? 0 : looks_without_activity + 1;
    before = now;
    if (looks_stopped < kLooksStopped && looks_without_activity < kLooksWithoutActivity) {
      continue;
    }
    // LTTng takes this for a daemon that ended, waits no longer, and tries again later.
    for (const DaemonConnection& connection : connections) {
      connection.shut_down();
    }
  }
  return nullptr;
}

}  // namespace tracetools
