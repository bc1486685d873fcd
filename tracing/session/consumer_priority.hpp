// Lets LTTng's consumer keep up on a busy machine.
#pragma once

#include <sys/types.h>

namespace tracing {

// Gives the threads of the consumers that the session daemon `daemon` has started a nice value of kConsumerNice. False
// when that isn't permitted (it takes root, or CAP_SYS_NICE) or there is no consumer: they go on as they were.
bool prefer_consumers(pid_t daemon);

inline constexpr int kConsumerNice = -10;

}  // namespace tracing
