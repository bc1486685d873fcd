// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/trace/session_end.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <exception>
#include <system_error>
#include <utility>

#include "base/files/pipe.hpp"

namespace tracing {

EnterOrSignal::EnterOrSignal() {
  sigset_t ending;
  sigemptyset(&ending);
  sigaddset(&ending, SIGINT);
  sigaddset(&ending, SIGTERM);
  sigaddset(&ending, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &ending, &previous_mask_);
  signals_ = signalfd(-1, &ending, SFD_CLOEXEC | SFD_NONBLOCK);
  if (signals_ < 0) {
    throw std::system_error(errno, std::generic_category(), "signalfd");
  }
}

EnterOrSignal::~EnterOrSignal() {
  while (take_signal()) {
  }  // else a second Ctrl-C, meant for the session, would end the program now
  close(signals_);
  pthread_sigmask(SIG_SETMASK, &previous_mask_, nullptr);
}

EnterOrSignal::Answer EnterOrSignal::wait() {
  std::array<pollfd, 2> fds = {pollfd{signals_, POLLIN, 0}, pollfd{STDIN_FILENO, POLLIN, 0}};
  while (true) {
    if (poll(fds.data(), fds.size(), -1) < 0) {
      continue;  // EINTR
    }
    if (take_signal()) {
      return Answer::kSignal;
    }
    if (fds[1].revents == 0) {
      continue;
    }
    char character = 0;  // one by one: the next line is for the next prompt
    const ssize_t length = read(STDIN_FILENO, &character, 1);
    if (length == 0 || (length < 0 && errno != EINTR && errno != EAGAIN)) {
      return Answer::kInputEnded;
    }
    if (length == 1 && character == '\n') {
      return Answer::kEnter;
    }
  }
}

bool EnterOrSignal::take_signal() {
  signalfd_siginfo taken{};
  return read(signals_, &taken, sizeof taken) == static_cast<ssize_t>(sizeof taken);
}

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
