// SPDX-License-Identifier: Apache-2.0
#include "base/terminal/terminal.hpp"

#include <signal.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>

namespace launch {

namespace {

std::string_view variable(const char* name) {
  const char* const value = ::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

bool shows_colour(int fd) {
  const std::string_view wish = variable("RCUTILS_COLORIZED_OUTPUT");
  if (wish == "0" || wish == "1") {
    return wish == "1";
  }
  return variable("NO_COLOR").empty() && takes_control_sequences(fd);
}

bool takes_control_sequences(int fd) {
  const std::string_view type = variable("TERM");
  return ::isatty(fd) != 0 && !type.empty() && type != "dumb";
}

TerminalSize terminal_size(int fd) {
  winsize size{};
  if (::ioctl(fd, TIOCGWINSZ, &size) != 0) {
    return {};
  }
  return {size.ws_col, size.ws_row};
}

std::size_t terminal_columns(int fd) {
  constexpr std::size_t kUsual = 80;
  const std::size_t columns = terminal_size(fd).columns;
  return columns > 0 ? columns : kUsual;
}

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
