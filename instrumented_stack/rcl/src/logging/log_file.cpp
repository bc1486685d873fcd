// SPDX-License-Identifier: Apache-2.0
#include "logging/log_file.hpp"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <new>
#include <system_error>

#include "rcl/logging_directory.hpp"
#include "rcl_logging_interface/rcl_logging_interface.h"
#include "rcutils/logging.h"

namespace rcl {

std::filesystem::path logging_directory() {
  const rcutils_allocator_t allocator = rcutils_get_default_allocator();
  char* directory = nullptr;
  if (rcl_logging_get_logging_directory(allocator, &directory) != RCL_LOGGING_RET_OK) {
    throw std::bad_alloc();
  }
  std::filesystem::path path(directory);
  allocator.deallocate(directory, allocator.state);
  return path;
}

LogFile::LogFile(std::string_view prefix) {
  using std::chrono::milliseconds;
  const auto now = std::chrono::duration_cast<milliseconds>(std::chrono::system_clock::now().time_since_epoch());
  std::string name(prefix.empty() ? program_invocation_short_name : prefix);
  name += "_" + std::to_string(getpid()) + "_" + std::to_string(now.count()) + ".log";
  path_ = logging_directory() / name;
}

LogFile::~LogFile() {
  if (fd_ >= 0) {
    close(fd_);
  }
}

void LogFile::write(int, const char*, std::string line) {
  std::string problem;
  std::call_once(opened_, [&] { problem = open(); });
  if (!problem.empty()) {
    rcutils_log(nullptr, RCUTILS_LOG_SEVERITY_WARN, "rcl", "no log file: %s", problem.c_str());
  }
  if (fd_ >= 0) {
    // A full disk must not stop a robot.
    [[maybe_unused]] const ssize_t written = ::write(fd_, line.data(), line.size());
  }
}

std::string LogFile::open() {
  std::error_code error;
  std::filesystem::create_directories(path_.parent_path(), error);
  if (error) {
    return "cannot create '" + path_.parent_path().string() + "': " + error.message();
  }
  fd_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (fd_ < 0) {
    return "cannot create '" + path_.string() + "': " + std::system_category().message(errno);
  }
  return {};
}

}  // namespace rcl
