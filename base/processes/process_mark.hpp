// SPDX-License-Identifier: Apache-2.0
// Environment variables by which launch-guardian knows the processes of a launch, wherever they are.
#pragma once

namespace launch {

// LAUNCH_PROCESS=ID:SIGTERM_TIMEOUT:SIGKILL_TIMEOUT:SCREEN:LABEL. ID is the number of the launch, the timeouts are
// milliseconds. SCREEN holds "o" if standard output goes to the screen, "e" if standard error does. spawn() gives it to
// every process.
inline constexpr char kMarkVariable[] = "LAUNCH_PROCESS";

// A process with this variable in its environment and with a session of its own goes on when the launch ends.
inline constexpr char kLeaveRunningVariable[] = "LAUNCH_LEAVE_RUNNING";

}  // namespace launch
