// SPDX-License-Identifier: Apache-2.0
// What has failed in a launch: processes that ended badly although nobody had asked them to end, that crashed while
// they were being ended, that could not be started, or that were unhealthy; components that could not be loaded. A
// process counts also if it was started again.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/process/process_event.hpp"

namespace launch {

class Failures {
 public:
  void on_process_event(const ProcessEvent& event);
  // `what` as in "component 'talker' was not loaded".
  void add(const std::string& what, const SourceRange& where);

  bool empty() const { return processes_.empty() && others_.empty(); }
  // Lines for the end of the launch: how each process failed, for how long it had run and at what cost, and its place.
  std::vector<std::string> summary() const;

 private:
  struct Process {
    std::string label;
    std::string last_failure;
    SourceRange where;
    std::size_t count = 0;
  };

  void add(const ProcessEvent& event, std::string failure);

  std::map<ProcessId, Process> processes_;
  std::vector<std::string> others_;
};

}  // namespace launch
