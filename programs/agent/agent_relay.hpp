// SPDX-License-Identifier: Apache-2.0
// The way of a launcher that comes back to the agent that waits for it: a second `launch agent` passes on all bytes,
// both ways.
#pragma once

#include <string>

#include "base/environment/environment.hpp"
#include "base/files/unique_fd.hpp"

namespace launch {

// Hands the request (ResumeRequest) to the agent and passes on what both say until one of them has gone. After the end
// of the agent it waits until its guardian has ended what was left, so that the connection ends after that. Returns the
// exit code. SIGPIPE must be ignored.
int relay_to_agent(const Environment& environment, const std::string& request, UniqueFd in, UniqueFd out);

}  // namespace launch
