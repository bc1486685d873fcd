// SPDX-License-Identifier: Apache-2.0
// Finds out whether a trace is still being written. Private to the reader.
#pragma once

#include <filesystem>

namespace tracing {

// A program has a file of the directory open for writing. False when the system can't tell, as with files of another
// user.
bool is_being_written(const std::filesystem::path& directory);

}  // namespace tracing
