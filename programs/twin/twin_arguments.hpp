// SPDX-License-Identifier: Apache-2.0
// The command line of `launch twin`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace twin_program {

struct Arguments {
  std::filesystem::path directory;
  std::filesystem::path folder;  // that gets twin.xml and twin.json
  std::vector<std::string> what_ifs;
  bool run = false;
  bool json = false;
  std::size_t top = 0;
  std::size_t cpus = 0;  // of the machine that was recorded; 0: not given
  std::uint64_t seed = 1;
  std::uint64_t bytes = 64;
  std::map<std::string, std::uint64_t> sizes;
  double duration_s = 0;  // 0: as long as the recording
  double calibration_s = 3;
};

// Returns the exit code when there is nothing more to do.
std::optional<int> parse_arguments(int argc, char** argv, Arguments& arguments);

}  // namespace twin_program
