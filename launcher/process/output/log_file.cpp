// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/output/log_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace launch {

namespace {

constexpr std::uint64_t kLeastForNote = 4096;  // a smaller file has no room for it

}  // namespace

bool LogFile::open() {
  fd_.reset(::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  struct stat status {};
  has_lines_ = true;
  size_ = fd_ && ::fstat(fd_.get(), &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
  return is_open();
}

int LogFile::append(std::string_view lines) {
  int error = 0;
  while (limits_.bytes != 0 && size_ + lines.size() > limits_.bytes) {
    // The lines that have room, or else one line that is longer than a file may be.
    const std::size_t room = limits_.bytes > size_ ? static_cast<std::size_t>(limits_.bytes - size_) : 0;
    const std::size_t end = room == 0 ? std::string_view::npos : lines.rfind('\n', room - 1);
    const std::size_t size = end != std::string_view::npos ? end + 1
                             : size_ > 0 && has_lines_     ? 0
                                                           : lines.find('\n') + 1;
    error = error != 0 ? error : write(lines.substr(0, size));
    lines.remove_prefix(size);
    if (lines.empty()) {
      break;
    }
    rotate();
  }
  error = error != 0 ? error : write(lines);
  return error != 0 && !std::exchange(failure_told_, true) ? error : 0;
}

int LogFile::write(std::string_view lines) {
  if (lines.empty()) {
    return 0;
  }
  if (!fd_ && !open()) {
    return errno;
  }
  size_ += lines.size();
  has_lines_ = true;
  while (!lines.empty()) {
    const ssize_t written = ::write(fd_.get(), lines.data(), lines.size());
    if (written >= 0) {
      lines.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

void LogFile::rotate() {
  for (int number = limits_.files - 1; number > 0; --number) {
    const std::string from = number == 1 ? path_ : fmt::format("{}.{}", path_, number - 1);
    ::rename(from.c_str(), fmt::format("{}.{}", path_, number).c_str());
  }
  if (limits_.files <= 1) {
    ::unlink(path_.c_str());
  }
  fd_.reset();
  size_ = 0;
  if (limits_.bytes >= kLeastForNote && open()) {
    write(
        limits_.files <= 1
            ? fmt::format("[launch] lines before this one were removed: this log holds {} bytes at most\n",
                          limits_.bytes)
            : fmt::format(
                  "[launch] lines before this one are in {}.1; of this log, the newest {} files of {} bytes are kept\n",
                  std::filesystem::path(path_).filename().string(), limits_.files, limits_.bytes));
    has_lines_ = false;
  }
}

}  // namespace launch
