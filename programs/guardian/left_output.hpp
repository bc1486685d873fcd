// SPDX-License-Identifier: Apache-2.0
// The output of processes whose launcher has gone. The launcher gives them pipes that they can read themselves: the
// pipes have a reader as long as they have a writer, so nobody dies of SIGPIPE, and what was written is kept.
#pragma once

#include <poll.h>
#include <sys/types.h>

#include <string>
#include <utility>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "launcher/process/guardian/process_scan.hpp"
#include "programs/guardian/guardian_log.hpp"

namespace launch {

class LeftOutput {
 public:
  explicit LeftOutput(GuardianLog& log) : log_(log) {}

  // Follows standard output and error of the process if they are pipes of the launcher and not followed yet.
  void follow(pid_t pid, const ProcessMark& mark);

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
