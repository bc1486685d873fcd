// SPDX-License-Identifier: Apache-2.0
// The checks of `launch check`: they find the errors of a launch file without running anything.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/language/registry.hpp"
#include "launcher/substitution/scope.hpp"
#include "programs/launch/check/recorded_nodes.hpp"
#include "programs/launch/check/recorded_parameters.hpp"

namespace launch {

struct CheckOptions {
  std::vector<std::pair<std::string, std::string>> arguments;  // name:=value
  bool strict_ros2 = false;                                    // what `ros2 launch` does not know is an error
  bool finds_leaks = false;                                    // what included files leave behind
  std::vector<RecordedNode> recorded_nodes;                    // of a run, which tell the names that remaps may change
  RecordedParameters recorded_parameters;                      // of nodes that were dumped
  std::function<void(std::size_t processes)> planned;          // told how many processes the file would start
};

// Loads and visits the file, including what conditions leave out, and resolves what a run would resolve: packages,
// programs, parameter files, included files. Errors are what would fail. Warnings are what is suspicious: arguments
// that nothing reads, remaps that match nothing, nodes of one name, and errors in what the conditions leave out with
// these arguments. Each problem is reported once, and every diagnostic has a
// finding.
std::vector<Diagnostic> check_launch_file(const std::string& path, const Registry& registry,
                                          const Environment& environment, const CheckOptions& options);

}  // namespace launch
