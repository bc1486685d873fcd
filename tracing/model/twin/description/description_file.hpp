// SPDX-License-Identifier: Apache-2.0
// The file of a twin: JSON, which the program of the stand-ins reads. A person may change it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "tracing/model/twin/description/twin_system.hpp"

namespace tracing::twin {

std::string description_of(const System& system);

// Throws std::runtime_error, with a sentence that begins with `name`, if the text is no description of a twin.
System parse_description(std::string_view text, const std::string& name);
// Throws std::runtime_error if the file cannot be read.
System read_description(const std::filesystem::path& file);

}  // namespace tracing::twin
