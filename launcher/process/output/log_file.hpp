// SPDX-License-Identifier: Apache-2.0
// A log file that whole lines are appended to. It is created with the first one. When it would get too large it becomes
// PATH.1, the former PATH.1 becomes PATH.2 and so on. The first line of the next file says so.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"

namespace launch {

class LogFile {
 public:
  // Which sizes and numbers of files are allowed; 0 bytes is no limit. The current file counts, too.
  struct Limits {
    std::uint64_t bytes = 0;
    int files = 1;
  };

  void set_path(const std::string& path) { path_ = path; }
  const std::string& path() const { return path_; }
  void set_limits(Limits limits) { limits_ = limits; }

  // Creates the file. False, with errno, if that fails.
  bool open();
  bool is_open() const { return static_cast<bool>(fd_); }
  void close() { fd_.reset(); }

  // Returns 0, or the number of the first error of this file, once: later lines are tried again without a word, since a
  // full disk may get room.
  int append(std::string_view lines);

 private:
  int write(std::string_view lines);
  void rotate();

  std::string path_;
  Limits limits_;
  UniqueFd fd_;
  std::uint64_t size_ = 0;
  bool has_lines_ = false;  // beside that first line
  bool failure_told_ = false;
};

}  // namespace launch
