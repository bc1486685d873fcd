// SPDX-License-Identifier: Apache-2.0
// The terminal of `launch top`, on ncurses: draws what it is given, and tells which keys were pressed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "programs/launch/top/top_rows.hpp"

namespace launch {

struct TopView {
  std::string heading;
  std::vector<TopRow> rows;
  std::size_t selected = 0;  // of `rows`
  std::string title;         // not empty: the lines of a process are shown instead of the table
  std::vector<std::string> lines;
  std::size_t scrolled = 0;  // lines from the end, or from the beginning
  bool from_beginning = false;
  std::string message;
  std::string prompt;  // not empty: the user types `input`
  std::string input;
  std::string keys;  // help
};

// Takes the terminal when it is made, and gives it back when it is destroyed. One at a time. Throws std::runtime_error
// when the terminal is not known.
class TopScreen {
 public:
  enum Key { kNone = -1, kUp = 1'000, kDown, kPageUp, kPageDown, kHome, kEnd, kEnter, kEscape, kBackspace, kResize };

  TopScreen();
  ~TopScreen();
  TopScreen(const TopScreen&) = delete;
  TopScreen& operator=(const TopScreen&) = delete;

  void draw(const TopView& view);
  // A Key, or the character that was typed. kNone: no key waits.
  int key();
  // Lines between heading and foot, and columns.
  std::size_t height() const;
  std::size_t width() const;

 private:
  void draw_table(const TopView& view);
  void draw_lines(const TopView& view);
  void put(int line, const std::string& text, int attributes = 0);

  std::size_t first_ = 0;  // row at the top
};

}  // namespace launch
