// SPDX-License-Identifier: Apache-2.0
// Reports what a system does while it runs, and at the end what `launch report` says of the whole trace.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tracing/show/live/live_screen.hpp"

namespace tracing {

// A live session: a URL or a name, as live_address() takes it. Waits until the relay daemon has it. Ends with the
// session, or when the user ends it. Returns false when the reading ended early. Throws TraceReadError.
bool report_live_session(const std::string& session, const LiveOptions& options);

// Directories that other programs may be writing to. Reads them anew for each drawing, so it shows the packets that are
// complete. Ends when nobody writes any more, or when the user ends it. Returns false when the trace is damaged. Throws
// TraceReadError.
bool report_growing_directories(const std::vector<std::filesystem::path>& directories, const LiveOptions& options);

}  // namespace tracing
