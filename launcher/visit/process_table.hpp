// SPDX-License-Identifier: Apache-2.0
// Every process that a launch was asked for, by the names that a launch file may use, and its state.
//
// The names of a process are its label ("talker-2", once it has started) and the label without its number. For a ROS
// node whose name is in the launch file they are also the node's name, plain and fully qualified.
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
  bool has_run = false;            // it was started, now or earlier
  bool is_over = false;            // it is done, or will never start
  std::optional<int> exit_code;    // of the last run that has ended
  bool is_watched = false;         // for its health
  bool is_healthy = false;
  bool is_gone = false;  // the launch file has it no longer
};

class ProcessTable {
 public:
  // Adds a process that was asked for. References stay valid as long as the table.
  TrackedProcess& add(const ProcessSpec& spec);
  // Gives the process its number, and with it its label, before the supervisor starts it.
  void bind(TrackedProcess& process, ProcessId id, const std::string& label);
  // Takes note of an event of a bound process, and returns the process; null for a process that was not added.
  TrackedProcess* note(const ProcessEvent& event);

  // From now on the process has the names of this spec.
  void rename(TrackedProcess& process, const ProcessSpec& spec);
  // From now on no name means this process.
  void forget(TrackedProcess& process);

  TrackedProcess* find(ProcessId id);
  // The processes of this name, in the order in which they were asked for.
  std::vector<TrackedProcess*> find(const std::string& name) const;
  // In the order in which they were asked for.
  const std::deque<TrackedProcess>& all() const { return processes_; }
  // All names but labels, for suggestions.
  std::vector<std::string> names() const;

 private:
  std::deque<TrackedProcess> processes_;
  std::unordered_map<ProcessId, TrackedProcess*> by_id_;
  std::unordered_map<std::string, std::vector<TrackedProcess*>> by_name_;
  std::unordered_map<std::string, TrackedProcess*> by_label_;
};

// The names of a process, each once.
std::vector<std::string> names_of(const ProcessSpec& spec);

}  // namespace launch
