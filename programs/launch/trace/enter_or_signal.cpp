// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/trace/enter_or_signal.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

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

}  // namespace tracing
