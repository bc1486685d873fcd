// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/trace/session_guard.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <system_error>
#include <utility>

#include "base/files/pipe.hpp"

namespace tracing {
namespace {

constexpr const char* kName = "launch-trace-guard";  // in ps(1)

// Reads until the other process has ended the guard, which is told by a byte, or is dead.
bool guard_has_ended(const launch::UniqueFd& pipe) {
  char byte = 0;
  ssize_t length = 0;
  while ((length = read(pipe.get(), &byte, 1)) < 0 && errno == EINTR) {
  }
  return length == 1;
}

// Nobody waits for what this process prints.
void leave_terminal() {
  setsid();
  const launch::UniqueFd nothing(open("/dev/null", O_RDWR | O_CLOEXEC));
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    dup2(nothing.get(), standard);
  }
}

}  // namespace

SessionGuard::SessionGuard(const std::function<void()>& clean_up) {
  launch::Pipe pipe = launch::make_pipe();
  waiting_ = fork();
  if (waiting_ < 0) {
    throw std::system_error(errno, std::generic_category(), "fork");
  }
  if (waiting_ == 0) {
    pipe.write.reset();
    leave_terminal();
    prctl(PR_SET_NAME, kName);
    if (!guard_has_ended(pipe.read)) {
      try {
        clean_up();
      } catch (const std::exception&) {
        // Nobody is left whom this could tell.
      }
    }
    _exit(0);
  }
  alive_ = std::move(pipe.write);
}

SessionGuard::~SessionGuard() {
  const char byte = 0;
  while (write(alive_.get(), &byte, 1) < 0 && errno == EINTR) {
  }
  while (waitpid(waiting_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace tracing
