// SPDX-License-Identifier: Apache-2.0
// What may be shown on a descriptor: colours, text in place of other text, lines of how many columns.
#pragma once

#include <cstddef>

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

}  // namespace launch
