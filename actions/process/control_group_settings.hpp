// SPDX-License-Identifier: Apache-2.0
// The attributes of processes and groups for limits that a cgroup holds: a row for each.
#pragma once

#include <vector>

#include "launcher/language/setting.hpp"
#include "launcher/process/control_groups/control_group.hpp"

namespace launch {

const std::vector<Setting<ControlGroupLimits>>& control_group_settings();

}  // namespace launch
