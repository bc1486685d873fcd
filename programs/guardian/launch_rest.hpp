// SPDX-License-Identifier: Apache-2.0
// What launch-guardian is told when it starts, and what it does when the launcher has gone.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <set>
#include <string>

#include "base/files/unique_fd.hpp"
#include "programs/guardian/clean_ups.hpp"
#include "programs/guardian/gentle_end.hpp"
#include "programs/guardian/guardian_log.hpp"

namespace launch {

// The launch, as the arguments tell (guardian_protocol.hpp).
struct GuardedLaunch {
  std::string id;
  pid_t launcher = -1;
  pid_t other = -1;  // the spare guardian for the guardian, the guardian for the spare
  int records = -1;
  std::set<pid_t> strangers{};
  // Those of the guardian and the launcher.
  pid_t group = ::getpgrp();
  pid_t session = ::getsid(0);
};

UniqueFd open_process(pid_t pid);
// Whether the process behind the descriptor has ended.
bool has_ended(const UniqueFd& process);
// To a process that is perhaps no child of this one.
void send_signal(const UniqueFd& process, int signal);

// Which processes belong to the launch, for one that is above them.
LaunchMembers members_below(const GuardedLaunch& launch);

// Ends what the launcher has left (gentle_end.hpp), unless the spare has told that nothing is, and runs its clean-up
// commands. False when a process could not be ended. `launcher_ended` and `signals` are those of GentleEnd::run().
bool end_rest(const GuardedLaunch& launch, LaunchMembers members, bool nothing_left, const std::string& launcher_ended,
              int signals);

// Runs what the launcher has left to be done, the latest first, and takes each command out of the records, so that
// nobody runs it again.
void run_clean_ups(int records, const LeftWork& work, GuardianLog& log, int signals);

// "the launcher was ended by SIGKILL", or "" when it has exited.
std::string launcher_ended(int status);

// A descriptor for all signals but those that say something about this process alone. They have been blocked since
// before this program. A SIGHUP that was ignored stays ignored (nohup).
UniqueFd watch_signals();

// Ends this process as one with this wait status has ended.
[[noreturn]] void end_with(int status);

}  // namespace launch
