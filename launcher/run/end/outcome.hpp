// SPDX-License-Identifier: Apache-2.0
// How a launch has ended: its exit code, and the lines that name what has failed.
//
// - 1 after an error of the launch itself, or if a process could not be ended;
// - the exit code of the `required` process that has ended the launch, 128+N when signal N ended it;
// - 128+N when a second signal N has cut the end short;
// - 3 when a process has failed, or a component could not be loaded (failures.hpp);
// - else 0, also after a signal.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/process/process_event.hpp"
#include "launcher/run/end/failures.hpp"

namespace launch {

// Whether the event ends the launch: a `required` process, or one with `on_exit`, has ended or can't start. A process
// that is ended to be started again does not end the launch.
bool ends_launch(const ProcessEvent& event);

class Outcome {
 public:
  // Failures of processes and components don't change the exit code, as with ros2 launch.
  void ignore_failures() { ignore_failures_ = true; }

  void on_process_event(const ProcessEvent& event);
  // This process has ended the launch, because it is required.
  void on_end_by(const ProcessEvent& event);
  void on_component_failure(const std::string& what, const SourceRange& where) { failures_.add(what, where); }
  void on_error() { exit_code_ = 1; }
  // A second or third signal has cut the end short.
  void on_hurry(int signal) { hurried_by_ = signal; }

  int exit_code() const;
  std::vector<std::string> summary() const { return failures_.summary(); }

 private:
  Failures failures_;
  int exit_code_ = 0;  // of an error, or of a required process
  int hurried_by_ = 0;
  bool ignore_failures_ = false;
};

}  // namespace launch
