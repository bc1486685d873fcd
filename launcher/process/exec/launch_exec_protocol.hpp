// SPDX-License-Identifier: Apache-2.0
// The interface between launch-exec and the launcher.
//
//   launch-exec STEP… - PROGRAM ARGV0 ARG…
//
// Each STEP is a letter and its value. When a step fails, launch-exec writes one LaunchExecFailure to descriptor
// kLaunchExecError. When PROGRAM begins, the descriptor is closed without any data.
#pragma once

namespace launch {

inline constexpr int kLaunchExecError = 3;
inline constexpr int kLaunchExecNamespaces = 4;  // and the numbers after it

inline constexpr char kStepNice = 'n';    // niceness
inline constexpr char kStepPolicy = 'p';  // POLICY,PRIORITY as numbers
// RUNTIME,DEADLINE,PERIOD in nanoseconds: SCHED_DEADLINE, of the main thread alone
inline constexpr char kStepDeadline = 'r';
inline constexpr char kStepTimerSlack = 's';    // nanoseconds
inline constexpr char kStepControlGroup = 'g';  // directory of a cgroup of version 2
inline constexpr char kStepOomScore = 'o';      // oom_score_adj
inline constexpr char kStepLockedMemory = 'l';  // bytes, or "unlimited"
inline constexpr char kStepCpus = 'c';          // numbers with commas
inline constexpr char kStepMemory = 'm';        // bytes
inline constexpr char kStepOpenFiles = 'f';     // descriptors
inline constexpr char kStepCoreFiles = 'd';     // no value: cores of any size that the hard limit allows
// How many namespaces are entered, in the order of their descriptors. The last step: what a user may do outside of a
// user namespace is not always allowed inside.
inline constexpr char kStepNamespaces = 'i';
inline constexpr char kStepExec = '-';  // the end of the steps, and the start of PROGRAM

struct LaunchExecFailure {
  char step;
  int error;  // errno
};

}  // namespace launch
