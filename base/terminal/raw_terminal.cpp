// SPDX-License-Identifier: Apache-2.0
#include "base/terminal/raw_terminal.hpp"

#include <termios.h>
#include <unistd.h>

namespace launch {

RawTerminal::RawTerminal(bool keeps_signals) : before_(TerminalState::of(STDIN_FILENO)) {
  termios modes{};
  if (!before_ || ::tcgetattr(STDIN_FILENO, &modes) != 0) {
    return;
  }
  if (keeps_signals) {
    modes.c_lflag &= ~tcflag_t{ICANON | ECHO};
  } else {
    ::cfmakeraw(&modes);
  }
  ::tcsetattr(STDIN_FILENO, TCSADRAIN, &modes);
}

RawTerminal::~RawTerminal() {
  if (before_) {
    before_->restore();
  }
}

}  // namespace launch
