// SPDX-License-Identifier: Apache-2.0
// `launch --trace`: records a launch whose file asks for no trace.
#pragma once

#include <memory>

#include "launcher/language/launch_description.hpp"
#include "launcher/language/registry.hpp"

namespace launch {

// The description with a <trace> of the default attributes at its end, named after the file and the time. It counts
// only when the visit of everything before has asked for no trace. Position is no matter: traces begin before
// processes.
std::shared_ptr<const LaunchDescription> with_trace(const LaunchDescription& description, const Registry& registry);

}  // namespace launch
