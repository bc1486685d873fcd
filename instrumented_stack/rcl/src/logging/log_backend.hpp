// SPDX-License-Identifier: Apache-2.0
// The logging backend that the environment chooses.
#pragma once

#include <memory>
#include <string>

#include "logging/external_log.hpp"

namespace rcl {

// RCL_LOGGING_IMPLEMENTATION selects it: `rcl_logging_spdlog`, or nothing, is a log file; `rcl_logging_noop` is null;
// any other name is a library that implements rcl_logging_interface. Throws std::runtime_error if the library cannot be
// loaded or refuses to begin.
std::unique_ptr<ExternalLog> open_external_log(const std::string& file_name_prefix, const std::string& config_file,
                                               int level);

}  // namespace rcl
