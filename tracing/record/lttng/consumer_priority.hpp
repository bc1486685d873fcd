// SPDX-License-Identifier: Apache-2.0
// Lets LTTng's daemons keep up on a busy machine.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace tracing {

// Gives the threads of the session daemon and of the consumers that it has started a nice value of kConsumerNice. So
// the consumers empty the buffers although every processor is busy, and the daemon registers new processes in time.
// Where that is not permitted, the threads keep their nice value, and the result is a sentence that says why and what
// would help. "" otherwise.
std::string prefer_daemons(pid_t daemon);

// The consumers that the session daemon has started.
std::vector<pid_t> consumers_of(pid_t daemon);
// The processes that make files for a session daemon or a consumer. It waits for them.
std::vector<pid_t> file_makers_of(pid_t daemon);

inline constexpr int kConsumerNice = -10;

}  // namespace tracing
