// SPDX-License-Identifier: Apache-2.0
// The limits of a process that cgroups hold, in the answer to "ps".
#pragma once

#include <string>

namespace launch {

// `,"control_groups":[…],"memory_share":0.7` of a process in the cgroup with this path: what limits it, the outermost
// first, with what is used. The share is that of the memory_max that is nearest to being used up.
std::string control_groups_text(const std::string& path);

}  // namespace launch
