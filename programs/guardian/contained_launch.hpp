// SPDX-License-Identifier: Apache-2.0
// The two processes that a contained launch has more (containment.hpp): the one outside that the user has started, and
// the first of the namespace.
#pragma once

#include <sys/types.h>

#include "base/files/unique_fd.hpp"

namespace launch {

// Passes signals to `first`, stops when the launch is stopped, and ends as it has ended. If the first process is
// killed, the kernel has ended all others in the namespace: then it runs the clean-up commands.
[[noreturn]] void stand_outside(pid_t first, int records, UniqueFd inside);

// Passes signals to the guardian, and reaps. When launcher, guardian and spare have gone, whatever has ended them, it
// kills what is left, runs clean-up commands that nobody has run, and ends; that is the end of the namespace. The
// guardian gets SIGTERM when the process outside has gone.
[[noreturn]] void be_first(pid_t guardian, int records, UniqueFd outside, UniqueFd alive);

}  // namespace launch
