// SPDX-License-Identifier: Apache-2.0
// A process namespace for a launch. When its first process ends, the kernel kills all others in it: no process of the
// launch can survive, whoever is killed.
#pragma once

#include <string>
#include <vector>

#include "base/files/unique_fd.hpp"

namespace launch {

// What the guardian of a contained launch has to keep.
struct Containment {
  UniqueFd records;  // the memory file of guardian_protocol.hpp
  UniqueFd proc;     // the /proc outside
  UniqueFd alive;    // the first process ends the namespace when nobody has this end of a pipe any more
};

// Splits this process: the calling process becomes one that passes signals to the namespace, and ends as the launch
// ends; a new one is the first of the namespace; and this function returns in a third one, inside. There it has the
// process number that the calling process has outside, and /proc shows the namespace. Must be called while there is one
// thread. Without privileges the namespace is in a user namespace. Throws std::system_error where the machine does not
// allow it; a missing `program`, launch-guardian, ends the process with exit code 1 and a message.
Containment contain_this_process(const std::vector<std::string>& command_line, const std::string& program);

}  // namespace launch
