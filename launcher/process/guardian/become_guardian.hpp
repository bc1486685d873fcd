// SPDX-License-Identifier: Apache-2.0
// How a process becomes launch-guardian.
#pragma once

#include <string>
#include <vector>

#include "base/files/unique_fd.hpp"

namespace launch {

// The memory file of guardian_protocol.hpp, with room for its table. Throws std::system_error.
UniqueFd make_guardian_records();

// With the descriptors `held`. Returns when the program can't be started, with errno.
void become_guardian(const std::string& program, const std::vector<std::string>& words, const std::vector<int>& held);

}  // namespace launch
