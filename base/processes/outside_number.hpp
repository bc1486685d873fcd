// SPDX-License-Identifier: Apache-2.0
// Process numbers as the rest of the machine knows them. They differ for a launch in a process namespace of its own.
#pragma once

#include <sys/types.h>

#include "base/files/unique_fd.hpp"

namespace launch {

// `proc` is the /proc of those outside, a directory that was opened before this process entered its namespace.
void keep_proc_of_outside(UniqueFd proc);

// The number outside of a process that runs or is not reaped. The number itself if this process is in no namespace of
// its own. A number is kept: of a process that has ended it is still known if somebody has asked before. For one
// thread.
pid_t number_outside(pid_t pid);

}  // namespace launch
