// SPDX-License-Identifier: Apache-2.0
// Where the guardian writes: on the screen and in launch.log, as the launcher writes them.
#pragma once

#include <poll.h>
#include <sys/types.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "launcher/process/guardian/process_scan.hpp"

namespace launch {

class GuardianLog {
 public:
  // Appends to the file of this path from now on.
  void open(const std::string& path);

  // The launcher was killed, perhaps while a status line was shown below all others (Screen).
  static void erase_status_line();

  // A message of the launcher: "[WARNING] [launch]: text".
  void say(std::string_view level, std::string_view text);
  // An error of a launch file, with its lines.
  void error(std::string_view text);
  // A line of a process.
  void write_line(std::string_view label, std::string_view line, bool on_screen);

 private:
  void write(std::string_view text, bool on_screen);

  UniqueFd log_;
};

// The output of processes whose launcher has gone. The launcher gives them pipes that they can read themselves: the
// pipes have a reader as long as they have a writer, so nobody dies of SIGPIPE, and what was written is kept.
class LeftOutput {
 public:
  explicit LeftOutput(GuardianLog& log) : log_(log) {}

  // Follows standard output and error of the process if they are pipes of the launcher and not followed yet.
  void follow(const FoundProcess& found, const ProcessMark& mark);

  // Adds what poll(2) has to wait for.
  void add_to(std::vector<pollfd>& descriptors) const;
  // Writes what there is to read. With `last` also the beginning of a line.
  void read(bool last = false);

 private:
  struct Stream {
    UniqueFd fd;
    std::pair<dev_t, ino_t> pipe;
    std::string label;
    bool on_screen;
    std::string rest;  // bytes of a line that has not ended yet
  };

  void read(Stream& stream);

  GuardianLog& log_;
  std::vector<Stream> streams_;
};

}  // namespace launch
