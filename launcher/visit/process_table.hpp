// SPDX-License-Identifier: Apache-2.0
// Every process that a launch was asked for, by the names that a launch file may use, and what has become of it.
//
// The names of a process are its label ("talker-2", once it has started), the label without its number, and for a ROS
// node whose name the launch file tells the node's name, plain and fully qualified.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "launcher/process/process_supervisor.hpp"

namespace launch {

struct TrackedProcess {
  std::vector<std::string> names;  // without the label
  ProcessId id = 0;                // 0: not started yet
  bool has_run = false;            // was started, now or earlier
  bool is_over = false;            // is done, or will never start
  std::optional<int> exit_code;    // of the last run that has ended
};

class ProcessTable {
 public:
  // A process that was asked for. References stay valid as long as the table.
  TrackedProcess& add(const ProcessSpec& spec);
  // It gets its number, and with it its label, before the supervisor starts it.
  void bind(TrackedProcess& process, ProcessId id, const std::string& label);
  // Takes note of an event of a bound process, and returns it; null for a process that nobody added.
  TrackedProcess* note(const ProcessEvent& event);

  TrackedProcess* find(ProcessId id);
  // In the order in which they were asked for.
  std::vector<TrackedProcess*> find(const std::string& name) const;
  // All names but labels, for suggestions.
  std::vector<std::string> names() const;

 private:
  std::deque<TrackedProcess> processes_;
  std::unordered_map<ProcessId, TrackedProcess*> by_id_;
  std::unordered_map<std::string, std::vector<TrackedProcess*>> by_name_;
  std::unordered_map<std::string, TrackedProcess*> by_label_;
};

// Its names, each once.
std::vector<std::string> names_of(const ProcessSpec& spec);

}  // namespace launch
