// SPDX-License-Identifier: Apache-2.0
// The attributes that <executable> and <node> share: how a process runs, where its output goes, when it runs again.
//
// An action that starts a process declares them beside its own, checks them when it is made, and keeps its Fields for
// request_process().
#pragma once

#include <vector>

#include "launcher/language/fields.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

// Declarations for an ActionType: those of the action's own, and then the common ones.
std::vector<AttributeSpec> with_process_attributes(std::vector<AttributeSpec> own);
std::vector<ItemSpec> process_items();

// Throws LaunchError for values that are wrong whatever a visit brings.
void check_process(const Fields& fields);

// Fills everything of the spec but its argv and its name, which must be set before, and asks the context to start the
// process. The launch prefix is put in front of argv. An empty name becomes the base name of argv[0].
void request_process(const Fields& fields, LaunchContext& context, ProcessSpec spec);

}  // namespace launch
