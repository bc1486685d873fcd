// SPDX-License-Identifier: Apache-2.0
// The modes of a terminal (echo, line editing), which a program that is killed does not set back, and its foreground
// group.
#pragma once

#include <termios.h>

#include <optional>

namespace launch {

class TerminalState {
 public:
  // Remembers the modes of the terminal behind the descriptor. Empty if there is none, and if another job of the shell
  // has it: those modes are not ours.
  static std::optional<TerminalState> of(int fd);

  // Sets the modes again. First takes the terminal back from a group that has gone. A terminal that another job has is
  // left as it is.
  void restore() const;

 private:
  TerminalState(int fd, const termios& modes) : fd_(fd), modes_(modes) {}

  int fd_;
  termios modes_;
};

}  // namespace launch
