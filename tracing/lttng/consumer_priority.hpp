// SPDX-License-Identifier: Apache-2.0
// Lets LTTng's consumer keep up on a busy machine.
#pragma once

#include <sys/types.h>

#include <string>

namespace tracing {

// Gives the threads of the consumers that the session daemon `daemon` has started a nice value of kConsumerNice, so
// that they empty the buffers although every processor is busy. Where that is not permitted, the threads keep their
// nice value, and the result is a sentence that says why and what would help. "" otherwise.
std::string prefer_consumers(pid_t daemon);

inline constexpr int kConsumerNice = -10;

}  // namespace tracing
