// SPDX-License-Identifier: Apache-2.0
// What may be shown on a descriptor: colours, text in place of other text, lines of how many columns. And the modes of
// the terminal behind it, for a program that may be killed while another one has changed them.
#pragma once

#include <termios.h>

#include <cstddef>
#include <optional>

namespace launch {

// Whether text gets colours. RCUTILS_COLORIZED_OUTPUT, which decides for the nodes, decides here, too: 0 is never, 1 is
// always. Otherwise a terminal that understands control sequences gets them, unless NO_COLOR is set and not empty
// (https://no-color.org).
bool shows_colour(int fd);

// Whether it is a terminal that can overwrite a line. TERM is set, and not "dumb".
bool takes_control_sequences(int fd);

// 0 means unknown.
struct TerminalSize {
  std::size_t columns = 0;
  std::size_t lines = 0;
};
TerminalSize terminal_size(int fd);

// Of a terminal that does not tell, 80.
std::size_t terminal_columns(int fd);

// The modes of a terminal (echo, line editing), which a program that is killed does not set back, and its foreground
// group.
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
