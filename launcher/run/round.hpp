// SPDX-License-Identifier: Apache-2.0
// What one traversal asked for, and the processes of it.
#pragma once

#include <vector>

#include "launcher/visit/process_table.hpp"
#include "launcher/visit/requests.hpp"

namespace launch {

struct Round {
  Requests requests;
  std::vector<TrackedProcess*> processes;  // of requests.processes; null: waits for something, and its spec is taken
};

}  // namespace launch
