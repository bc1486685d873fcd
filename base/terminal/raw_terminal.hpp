// SPDX-License-Identifier: Apache-2.0
// A terminal that gives each key to a program: no line editing, no echo, no change of what is printed.
#pragma once

#include <optional>

#include "base/terminal/terminal.hpp"

namespace launch {

// Of standard input, until it is destroyed. Does nothing if that is no terminal, or if another job of the shell has it.
class RawTerminal {
 public:
  // `keeps_signals`: Ctrl-C and the like are signals still, and output is as usual.
  explicit RawTerminal(bool keeps_signals = false);
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

 private:
  std::optional<TerminalState> before_;
};

}  // namespace launch
