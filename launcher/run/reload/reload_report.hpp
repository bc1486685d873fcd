// SPDX-License-Identifier: Apache-2.0
// What a reload does, for those who have asked for it and for those who watch the launch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

using ReloadNumber = std::uint64_t;  // from 1 on

// The difference between what runs and what the launch file asks for, or why there will be none.
struct ReloadReport {
  struct Line {
    std::string process;               // its label; of a new one without a number
    std::vector<std::string> changes;  // "command line: sleep 10 -> sleep 20"
    SourceRange where{};               // in the file as it is now; none of a process that is gone
  };

  ReloadNumber number = 0;
  bool only_shown = false;         // nothing is carried out
  std::vector<Diagnostic> errors;  // of the launch file; nothing is carried out then
  std::string refused;             // a sentence: why the launch does not reload
  std::vector<Line> starts;
  std::vector<Line> ends;
  std::vector<Line> restarts;
  std::vector<Line> sets;          // parameters of nodes that go on
  std::vector<Line> takes_over;    // what needs no start
  std::size_t stays = 0;           // processes
  std::vector<std::string> notes;  // sentences about what else has changed
  Duration took{0};                // to read, to visit and to compare

  bool failed() const { return !errors.empty() || !refused.empty(); }
  // Whether the launch file asks for what is there already.
  bool changes_nothing() const {
    return starts.empty() && ends.empty() && restarts.empty() && sets.empty() && takes_over.empty() && notes.empty();
  }
};

// It has been carried out.
struct ReloadEnd {
  ReloadNumber number = 0;
  std::vector<std::string> failures;  // sentences: "talker-1 has not started: …"
};

// "reload: 1 starts (mapper), 1 restarts (talker-1), 4 stay"
std::string summary(const ReloadReport& report);

}  // namespace launch
