// SPDX-License-Identifier: Apache-2.0
// What a plan can't tell, because it depends on a function of a launch file.
//
// A plan calls the functions that make a description. It does not call functions that wait for an event or a timer,
// because they act on the running system. The plan names these functions instead. It also names the later actions that
// can't be visited without their effects.
#pragma once

#include <string>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

struct LeftToRun {
  std::string function;  // that would be called; empty for an action that depends on an earlier function
  std::string error;     // of such an action, without that function
  SourceRange where;
};

// Thrown where the function would be called. LaunchContext catches it and leaves the action to a run.
class OnlyARunCalls : public LaunchError {
 public:
  OnlyARunCalls(std::string function, SourceRange where)
      : LaunchError("'" + function + "' is a function that only a run calls", std::move(where)),
        function_(std::move(function)) {}

  const std::string& function() const { return function_; }

 private:
  std::string function_;
};

}  // namespace launch
