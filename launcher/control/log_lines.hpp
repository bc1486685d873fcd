// SPDX-License-Identifier: Apache-2.0
// What processes have printed so far, as launch.log has it.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <set>
#include <string>

namespace launch {

// Bytes of a file, from `begin` up to `end`. A line that `begin` cuts is left out.
struct LogRange {
  std::size_t begin = 0;
  std::size_t end = static_cast<std::size_t>(-1);
};

// The last lines, `most` of them, of the processes with these names: "[talker-1] text". A file that can't be read has
// none.
std::deque<std::string> past_lines(const std::string& log, LogRange range,
                                   const std::set<std::string, std::less<>>& names, std::size_t most);

}  // namespace launch
