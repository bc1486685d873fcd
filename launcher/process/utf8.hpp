// SPDX-License-Identifier: Apache-2.0
// Checks and repairs UTF-8.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace launch {

bool is_utf8(std::string_view bytes);

// Appends the bytes with U+FFFD for each part that is not UTF-8: one for each longest start of a character that does
// not go on (Unicode 15, section 3.9, "substitution of maximal subparts"; the same as Python's errors="replace").
void append_as_utf8(std::string& to, std::string_view bytes);

// How many bytes at the end are the start of a character whose rest may still come (0 to 3).
std::size_t incomplete_utf8_suffix(std::string_view bytes);

}  // namespace launch
