// SPDX-License-Identifier: Apache-2.0
// What would go wrong only when a trace begins, as remarks of a visit that explores.
#pragma once

#include <lttng/domain.h>

#include <string>
#include <vector>

#include "launcher/visit/launch_context.hpp"

namespace launch {

// A session does not begin with an unknown context field.
void find_unknown_context_fields(const std::vector<std::string>& fields, lttng_domain_type domain,
                                 const SourceRange& where, LaunchContext& context);
// An event of ROS 2 that does not exist is never recorded.
void find_unknown_events(const std::vector<std::string>& rules, const SourceRange& where, LaunchContext& context);

}  // namespace launch
