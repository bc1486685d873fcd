// SPDX-License-Identifier: Apache-2.0
// The names that the nodes of a recorded run had. A launch file does not tell them: a program makes its topics itself.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace launch {

struct RecordedNode {
  std::string name;             // fully qualified
  std::string program;          // the name of its process, of which the kernel keeps 15 characters
  std::set<std::string> names;  // of its topics and services, fully qualified, after all remaps
};

// The nodes of a trace. Another program reads it. Nothing, and a message on standard error, when the trace can't be
// read or has no nodes.
std::optional<std::vector<RecordedNode>> read_recorded_nodes(const std::string& trace_directory);

}  // namespace launch
