// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace launch {

// In quotes, as systemd reads them (systemd.syntax(7)). "%" begins a specifier everywhere, "$" a variable in a command.
// Bytes that are no UTF-8, or that would end the line, are escaped.
std::string systemd_quoted(std::string_view text, bool in_command);

// A value without quotes, for people: what a line can't hold becomes "?".
std::string systemd_line(std::string_view text);

// Whether systemd takes the absolute path, with each "%" doubled, as a program or a directory.
bool is_systemd_path(std::string_view path);

// A name of a unit, without its ending: characters that a unit can't have become "-".
std::string unit_name(std::string_view text);

}  // namespace launch
