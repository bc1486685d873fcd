// SPDX-License-Identifier: Apache-2.0
// `launch --trace`: records a launch whose file asks for no trace.
#pragma once

#include <memory>

#include "launcher/language/launch_description.hpp"
#include "launcher/language/registry.hpp"

namespace launch {

// Returns the description with a <trace> of the default attributes at its end, named after the file and the time. This
// <trace> counts only when the visit has met no other one before. It may stand at the end because traces begin before
// processes.
std::shared_ptr<const LaunchDescription> with_trace(const LaunchDescription& description, const Registry& registry);

}  // namespace launch
