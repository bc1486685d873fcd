// SPDX-License-Identifier: Apache-2.0
// What a program has changed on the terminal that it writes to: the alternate screen, a hidden cursor, other codes for
// keys. A terminal that shows the program from some moment on needs the changes, and one that stops showing it must be
// set back.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace launch {

// Knows the private modes of DEC terminals (ESC [ ? N h), the keypad (ESC =), the region that scrolls (ESC [ N ; N r),
// and the full reset (ESC c).
class TerminalModes {
 public:
  // Takes bytes as they come; a sequence may be cut anywhere.
  void add(std::string_view bytes);

  // Whether the program draws on the alternate screen, as editors and other programs on the whole terminal do.
  bool on_alternate_screen() const;
  // What brings a terminal in its usual modes into these.
  std::string entering() const;
  // What brings it back. The colours are set back, too.
  std::string leaving() const;

 private:
  void obey(char last);

  std::map<int, bool> changed_;  // private modes that are not as usual, and how they are
  bool keypad_ = false;
  std::string region_;    // "2;20"; empty: the whole screen
  std::string sequence_;  // that has begun
};

}  // namespace launch
