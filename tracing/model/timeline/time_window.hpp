// SPDX-License-Identifier: Apache-2.0
// A part of a timeline, as if the trace had begun later and ended earlier.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tracing/model/timeline/timeline.hpp"

namespace tracing::timeline {

// Keeps the instances that start, and the messages that are published, from `begin_ns` on and before `end_ns`, and the
// states of nodes and threads between. Objects stay. The window is cut to that of the timeline.
void keep_window(Timeline& timeline, std::int64_t begin_ns, std::int64_t end_ns);

// Until when there are at most `records` instances, messages and states of threads; the end of the timeline if there
// are no more.
std::int64_t end_of_first(const Timeline& timeline, std::size_t records);

}  // namespace tracing::timeline
