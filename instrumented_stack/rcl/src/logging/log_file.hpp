// SPDX-License-Identifier: Apache-2.0
// The log file of a process, named as rcl_logging_spdlog does.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>

#include "logging/external_log.hpp"

namespace rcl {

// `<logging_directory()>/<prefix>_<pid>_<milliseconds since 1970>.log`; an empty prefix means the name of the program.
// The first line creates the file and its directory. Each line is written at once, so a crash loses none. Thread safe.
class LogFile final : public ExternalLog {
 public:
  explicit LogFile(std::string_view prefix);
  ~LogFile() override;
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  // Warns once if the file cannot be created. The process goes on without it.
  void write(int severity, const char* name, std::string line) override;

 private:
  // Returns the problem; empty if the file is open.
  std::string open();

  std::filesystem::path path_;
  std::once_flag opened_;
  int fd_ = -1;
};

}  // namespace rcl
