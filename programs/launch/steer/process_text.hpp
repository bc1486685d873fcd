// SPDX-License-Identifier: Apache-2.0
// How `launch ps` and `launch top` show what a launch says about a process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace launch {

// "running", "running, unhealthy", "ended: exit code 1", "ended: SIGSEGV".
std::string state_text(const nlohmann::ordered_json& process);
// `status` is what a process that runs says of itself: "running, healthy (map loaded)".
std::string state_text(const std::string& state, const std::string& end, const std::string& health,
                       const std::string& status = {});
// "exit code 1", "SIGSEGV".
std::string end_text(const nlohmann::ordered_json& end);
// " (70 %)", of a limit; "" if it is negative.
std::string share_text(double share);
// "12.3 MiB"
std::string memory_text(std::uint64_t bytes);
// "0:07", "12:03", "3:04:05", "12 d 3:04"
std::string duration_text(double seconds);
// "system.launch.xml:4", the file relative to the current directory if it is below it. "-" for no place.
std::string place_text(const nlohmann::ordered_json& place);
std::string place_text(const std::string& file, int line);
// Columns of a terminal that a text takes, a column for each character.
std::size_t columns_of(std::string_view text);

}  // namespace launch
