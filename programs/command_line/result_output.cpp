// SPDX-License-Identifier: Apache-2.0
#include "programs/command_line/result_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/diagnostics/command_error.hpp"
#include "base/terminal/terminal.hpp"

namespace launch {

ResultOutput::ResultOutput(std::string command) : command_(std::move(command)) {
  std::fflush(stdout);
  const int former = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (former < 0) {
    return;
  }
  file_ = ::fdopen(former, "w");
  if (::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {  // without standard error
    const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nothing >= 0) {
      ::dup2(nothing, STDOUT_FILENO);
      ::close(nothing);
    }
  }
}

ResultOutput::~ResultOutput() {
  std::fflush(stdout);
  if (file_ != nullptr) {
    std::fflush(file_);
    ::dup2(::fileno(file_), STDOUT_FILENO);
    std::fclose(file_);
  }
}

void ResultOutput::print(std::string_view text) {
  if (file_ != nullptr && std::fwrite(text.data(), 1, text.size(), file_) < text.size()) {
    note_error();
  }
}

bool ResultOutput::finish() {
  if (file_ != nullptr && std::fflush(file_) != 0) {
    note_error();
  }
  if (error_ != 0) {
    const std::string message = std::string("the output can't be written: ") + std::strerror(error_);
    std::fputs(command_error(command_, message).c_str(), stderr);
  }
  return error_ == 0;
}

void ResultOutput::note_error() {
  if (error_ == 0) {
    error_ = errno != 0 ? errno : EIO;
  }
}

bool ResultOutput::has_colour() const {
  return file_ != nullptr && shows_colour(::fileno(file_));
}

}  // namespace launch
