// SPDX-License-Identifier: Apache-2.0
// Keeps the configuration of a session in a file, in LTTng's own format: `lttng save` and `lttng load` read it, too.
#pragma once

#include <string>

namespace tracing {

// Both throw TraceError. The file is DIRECTORY/SESSION.lttng; an empty directory is LTTng's own for the user. A file
// that exists is replaced; a session that exists is not.
void save_session(const std::string& lttng_session_name, const std::string& directory);
void load_session(const std::string& lttng_session_name, const std::string& directory);

}  // namespace tracing
