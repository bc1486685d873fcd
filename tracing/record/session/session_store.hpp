// SPDX-License-Identifier: Apache-2.0
// Keeps the configuration of a session in a file, in LTTng's own format: `lttng save` and `lttng load` read it, too.
#pragma once

#include <string>

namespace tracing {

// The file of a session: DIRECTORY/SESSION.lttng. An empty directory is that of LTTng for the user, whoever runs the
// session daemon: .lttng/sessions in $LTTNG_HOME or the home directory.
std::string file_of_saved_session(const std::string& lttng_session_name, const std::string& directory);

// Both throw TraceError. A file that exists is replaced; a session that exists is not.
void save_session(const std::string& lttng_session_name, const std::string& directory);
void load_session(const std::string& lttng_session_name, const std::string& directory);

}  // namespace tracing
