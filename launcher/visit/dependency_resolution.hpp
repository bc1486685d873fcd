// SPDX-License-Identifier: Apache-2.0
// Finds the process that each `depends_on` of a traversal means.
#pragma once

#include <vector>

#include "launcher/visit/dependency.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

// Finds the processes that the conditions name and sets Dependency::target. A name means one of `asked_for`, or else
// the latest that was asked for before. Throws LaunchError with every name that is unknown or ambiguous.
void resolve_targets(std::vector<Dependency>& dependencies, const std::vector<TrackedProcess*>& asked_for,
                     const ProcessTable& table);

// Does the same, and looks for cycles. `asked_for` are the processes that the dependencies belong to, already in the
// table. Throws LaunchError as before, and for a cycle.
void resolve_dependencies(std::vector<Dependency>& dependencies, const std::vector<TrackedProcess*>& asked_for,
                          const ProcessTable& table);

}  // namespace launch
