// SPDX-License-Identifier: Apache-2.0
// The kinds of <watch …/>: what is watched of a process, and the attributes that some kinds have.
#pragma once

#include <string>
#include <vector>

#include "launcher/language/fields.hpp"
#include "launcher/process/health_watch.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

// "executor", "output" and so on.
const std::vector<std::string>& watch_kinds();
// The declarations of the attributes of some kinds.
std::vector<AttributeSpec> watch_subject_attributes();

// Throws LaunchError for attributes that don't go together, or that are wrong whatever a visit brings.
void check_watch_subject(const Fields& fields, const std::string& kind);

// Of a watch of this process. Throws LaunchError.
WatchSubject perform_watch_subject(const Fields& fields, const std::string& kind, Scope& scope,
                                   const ProcessSpec& process);

// Sets what depends on the kind and is not given: the interval is 0, the failures are 0. Throws LaunchError if the time
// and the subject don't go together.
void complete_watch(const Fields& fields, HealthWatch& watch);

}  // namespace launch
