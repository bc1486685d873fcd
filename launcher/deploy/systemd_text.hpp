// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace launch {

// In quotes, as systemd reads them. "%" begins a specifier everywhere, "$" a variable in a command.
std::string systemd_quoted(std::string_view text, bool in_command);

// A name of a unit, without its ending: characters that a unit can't have become "-".
std::string unit_name(std::string_view text);

}  // namespace launch
