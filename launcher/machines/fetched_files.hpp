// SPDX-License-Identifier: Apache-2.0
// Files of another machine, written into a directory here. What the machine says of them is not trusted: a name leads
// nowhere but below the directory, and sizes, depth and number of the files are bounded.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"

namespace launch {

// What the launch itself writes into the folder of a machine (clock_offset.hpp). No machine may send such a file.
inline constexpr const char* kClockFile = "clock.json";

// The components of a path are names, none is `.` or `..`, it is relative, not too deep, and prints on one line. The
// file is not called kClockFile.
bool is_path_of_fetched_file(std::string_view path);

class FetchedFiles {
 public:
  // The directory gets its name in finish() alone. Until then it has a "~" behind it, which no name of a machine has:
  // so whatever ends the launch, what has come in part is not taken for the whole. Throws std::system_error, also if
  // something is at one of the two names.
  explicit FetchedFiles(std::string directory);

  // One file after another. These throw WireError for what no agent sends, and std::system_error when the disk does not
  // take it.
  void begin_file(const std::string& path, std::uint64_t size);
  void add(std::string_view bytes);
  void end_file(std::uint64_t sum);
  // Of all files, so far.
  std::uint64_t bytes() const { return bytes_; }

  // One of this side.
  void add_own_file(const std::string& name, const std::string& text);
  // Throws WireError if that is not what has come, and std::system_error.
  void finish(std::uint32_t files, std::uint64_t bytes);

  // Removes all that has been written.
  void remove() noexcept;

 private:
  std::string directory_;
  std::string part_;  // its name until it is whole
  UniqueFd folder_;
  UniqueFd file_;
  std::uint64_t left_ = 0;
  std::uint64_t sum_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint32_t files_ = 0;
};

}  // namespace launch
