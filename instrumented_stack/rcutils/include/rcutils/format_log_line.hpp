// SPDX-License-Identifier: Apache-2.0
// The text of log messages, for output handlers.
#pragma once

#include <cstdarg>
#include <string>

#include "rcutils/logging.h"

namespace rcutils {

// The line that the console gets, without colours, with its newline. Takes what an output handler is called with;
// `args` can be used again.
std::string format_log_line(const rcutils_log_location_t* location, int severity, const char* name,
                            rcutils_time_point_value_t timestamp, const char* format, va_list* args);

}  // namespace rcutils
