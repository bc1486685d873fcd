// SPDX-License-Identifier: Apache-2.0
// The answer of a launch to "ps", as plain data. It is read without a tree of JSON values in between, which would take
// as long as everything else that `launch ps` does with a thousand processes.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace launch {

struct ListedProcess {
  std::string name;
  std::string state;           // "running", … (docs/control.md)
  std::string health;          // "starting", "healthy", "unhealthy"; "" if it is not watched
  std::string status;          // what it says of itself
  std::string end;             // of the last run: "exit code 1", "SIGSEGV"; "" if none has ended
  std::string machine;         // on which it runs; "": this one
  bool away = false;           // that machine can't be reached now
  pid_t pid = -1;              // -1: it does not run here
  pid_t pid_there = -1;        // its number on that machine; -1: it does not run there
  std::int64_t restarts = -1;  // -1: it has not been started
  double running_for = 0;      // seconds
  double memory_share = -1;    // of the memory_max that is nearest to being used up; negative: there is none
  std::size_t file = 0;        // its place: the number in ListedLaunch::places
  int line = 0;                // 0: no file asked for it
};

struct ListedLaunch {
  pid_t pid = -1;
  std::string state;
  std::string isolation;            // "" if it is not isolated
  double running_for = 0;           // seconds
  std::vector<std::string> files;   // those of the command line
  std::vector<std::string> places;  // the files that have asked for processes
  std::vector<ListedProcess> processes;
};

// Reads the line, and calls `on_process` after each process. Throws ControlError: with the text of the launch if it
// refuses, or if this is no such answer.
ListedLaunch read_ps_answer(std::string_view line, std::function<void(const ListedProcess&)> on_process = {});

}  // namespace launch
