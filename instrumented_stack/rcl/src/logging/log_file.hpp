// SPDX-License-Identifier: Apache-2.0
// The file in which a process keeps its log lines, as rcl_logging_spdlog names it.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>

namespace rcl {

// `<logging_directory()>/<prefix>_<pid>_<milliseconds since 1970>.log`; an empty prefix stands for the name of the
// program. Made, with its directory, when the first line comes. Each line is written at once, so a crash loses none.
// Thread safe.
class LogFile {
 public:
  explicit LogFile(std::string_view prefix);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  // Warns, once, when there can be no file; the process goes on without one.
  void write(std::string_view line);

 private:
  // What is wrong; empty when the file is open.
  std::string open();

  std::filesystem::path path_;
  std::once_flag opened_;
  int fd_ = -1;
};

}  // namespace rcl
