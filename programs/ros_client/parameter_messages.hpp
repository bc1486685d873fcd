// SPDX-License-Identifier: Apache-2.0
// Parameters of a launch file as the services of nodes take them.
#pragma once

#include <rcl_interfaces/msg/parameter.hpp>
#include <vector>

#include "launcher/substitution/parameter.hpp"

namespace launch {

// Only the last parameter of each name, because a container would refuse a name that comes twice.
std::vector<rcl_interfaces::msg::Parameter> messages_of(const std::vector<NamedParameter>& parameters);

}  // namespace launch
