// SPDX-License-Identifier: Apache-2.0
// The spare guardian, in a process group of its own, where the keys of the terminal and the signals to the process
// group of the launch do not reach it.
#pragma once

#include "base/files/unique_fd.hpp"
#include "programs/guardian/launch_rest.hpp"

namespace launch {

// Between the guardian and the launcher. As the nearest one above, it adopts each orphan of the launch, and reaps it.
// While the guardian lives, all that is to be done is its business; the spare tells it what only a parent learns: how
// the launcher has ended, and that it has no child any more, so that nothing of the launch is left. The guardian ends
// it then. When the guardian has been killed, the spare starts another one, asks the launcher to end, and does the
// rest. `ready` is closed when it stands.
[[noreturn]] void stand_between(GuardedLaunch launch, UniqueFd ready);

// A spare that is not above the launcher: the guardian or the first spare was killed, or both were. It does its work
// when the launcher and the guardian that is left have gone, and finds the processes by their marks. `guardian` is
// empty when there is none.
[[noreturn]] void stand_beside(const GuardedLaunch& launch, const UniqueFd& guardian);

// Starts one below this guardian. Returns its number.
pid_t start_beside(const GuardedLaunch& launch, const UniqueFd& self);

}  // namespace launch
