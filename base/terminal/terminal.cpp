// SPDX-License-Identifier: Apache-2.0
#include "base/terminal/terminal.hpp"

#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

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

}  // namespace launch
