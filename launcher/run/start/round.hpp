// SPDX-License-Identifier: Apache-2.0
// The requests of one traversal, and its processes.
#pragma once

#include <vector>

#include "launcher/visit/process_table.hpp"
#include "launcher/visit/requests.hpp"

namespace launch {

struct Round {
  Requests requests;
  std::vector<TrackedProcess*> processes;  // of requests.processes; null: it waits, and its spec was taken
};

}  // namespace launch
