// SPDX-License-Identifier: Apache-2.0
// What the guardian says, and the last lines of processes: on the screen and in launch.log, as the launcher writes
// them.
#pragma once

#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"

namespace launch {

class GuardianLog {
 public:
  // Appends to the file of this path from now on.
  void open(const std::string& path);

  // The launcher was killed, perhaps while a status line was shown below all others (Screen).
  static void erase_status_line();

  // A message of the launcher: "[WARNING] [launch]: text".
  void say(std::string_view level, std::string_view text);
  // A line of a process.
  void write_line(std::string_view label, std::string_view line, bool on_screen);

 private:
  void write(std::string_view text, bool on_screen);

  UniqueFd log_;
};

}  // namespace launch
