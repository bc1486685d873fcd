// SPDX-License-Identifier: Apache-2.0
// Formats log messages for output handlers.
#pragma once

#include <cstdarg>
#include <string>

#include "rcutils/logging.h"

namespace rcutils {

// The line for the console, without colours, with its newline. Takes the arguments of an output handler; `args` can be
// used again.
std::string format_log_line(const rcutils_log_location_t* location, int severity, const char* name,
                            rcutils_time_point_value_t timestamp, const char* format, va_list* args);

}  // namespace rcutils
