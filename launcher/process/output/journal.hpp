// SPDX-License-Identifier: Apache-2.0
// systemd's journal, when it is what a launch writes to: each line becomes an entry with fields
// (systemd.journal-fields(7), the native protocol of systemd-journald).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/environment/environment.hpp"
#include "base/files/unique_fd.hpp"

namespace launch {

// The priority of a line that begins with a level as ROS 2 and the launcher write it, "[ERROR] …": that of syslog(3).
// Without a level: 6, information.
int journal_priority(std::string_view line);

class Journal {
 public:
  // Null if the descriptor does not lead to the journal (JOURNAL_STREAM).
  static std::shared_ptr<const Journal> behind(int fd, const Environment& environment);

  // Where a line comes from. All may be empty.
  struct Origin {
    std::string process;       // LAUNCH_PROCESS: "talker-1"
    std::string node;          // LAUNCH_NODE: "/left/talker"
    std::string file;          // CODE_FILE, the launch file
    unsigned line_number = 0;  // CODE_LINE
  };

  // False if the journal does not take the line now. Never waits.
  bool write(std::string_view line, int priority, const Origin& origin) const;

 private:
  explicit Journal(UniqueFd fd) : fd_(std::move(fd)) {}

  UniqueFd fd_;
};

}  // namespace launch
