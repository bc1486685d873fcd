// SPDX-License-Identifier: Apache-2.0
#include "base/terminal/terminal_state.hpp"

#include <signal.h>
#include <unistd.h>

#include <cerrno>

namespace launch {

std::optional<TerminalState> TerminalState::of(int fd) {
  termios modes{};
  if (::tcgetpgrp(fd) != ::getpgrp() || ::tcgetattr(fd, &modes) != 0) {
    return std::nullopt;
  }
  return TerminalState(fd, modes);
}

void TerminalState::restore() const {
  const pid_t foreground = ::tcgetpgrp(fd_);
  if (foreground < 0) {
    return;
  }
  if (foreground != ::getpgrp()) {
    if (::kill(-foreground, 0) == 0 || errno != ESRCH) {
      return;
    }
    // SIGTTOU would stop a program of the background that takes the terminal.
    sigset_t stop;
    sigset_t before;
    sigemptyset(&stop);
    sigaddset(&stop, SIGTTOU);
    ::pthread_sigmask(SIG_BLOCK, &stop, &before);
    ::tcsetpgrp(fd_, ::getpgrp());
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }
  ::tcsetattr(fd_, TCSANOW, &modes_);
}

}  // namespace launch
