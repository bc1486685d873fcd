// SPDX-License-Identifier: Apache-2.0
// A trace as one input of a fuzz target: its metadata and its stream files, with a line between them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

inline constexpr std::string_view kDivider = "\n--stream--\n";

// The files of a directory with one trace.
inline std::string trace_as_input(const std::filesystem::path& directory) {
  const auto content = [](const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  };
  std::vector<std::filesystem::path> streams;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().filename() != "metadata") {
      streams.push_back(entry.path());
    }
  }
  std::sort(streams.begin(), streams.end());
  std::string input = content(directory / "metadata");
  for (const std::filesystem::path& stream : streams) {
    input.append(kDivider).append(content(stream));
  }
  return input;
}

// Writes the files into the directory, which must exist. What is in it is removed.
inline void write_trace(const std::filesystem::path& directory, std::string_view input) {
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    std::filesystem::remove(entry.path());
  }
  std::string name = "metadata";
  for (std::size_t stream = 0;; ++stream) {
    const std::size_t end = input.find(kDivider);
    std::ofstream(directory / name, std::ios::binary) << input.substr(0, end);
    if (end == std::string_view::npos) {
      return;
    }
    input.remove_prefix(end + kDivider.size());
    name = "stream_" + std::to_string(stream);
  }
}

}  // namespace fuzz
