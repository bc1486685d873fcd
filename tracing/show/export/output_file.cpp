// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/export/output_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace tracing {

namespace fs = std::filesystem;

OutputError::OutputError(const fs::path& file, const std::string& reason)
    : std::runtime_error(fmt::format("cannot write {}: {}", file.native(), reason)) {}

OutputFile::OutputFile(fs::path file) : file_(file == "-" ? "/dev/stdout" : std::move(file)), unfinished_(file_) {
  std::error_code ignored;
  if (fs::is_directory(file_, ignored)) {
    throw OutputError(file_, std::strerror(EISDIR));
  }
  if (!fs::exists(file_, ignored) || fs::is_regular_file(file_, ignored)) {
    unfinished_ += fmt::format(".{}.part", getpid());
  }
  stream_ = std::fopen(unfinished_.c_str(), "wb");
  if (stream_ == nullptr) {
    fail();
  }
}

OutputFile::~OutputFile() {
  if (stream_ == nullptr) {
    return;
  }
  std::fclose(stream_);
  if (unfinished_ != file_) {
    unlink(unfinished_.c_str());
  }
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stream_) != text.size()) {
    fail();
  }
}

void OutputFile::finish() {
  if (std::fflush(stream_) != 0) {
    fail();
  }
  if (unfinished_ != file_ && std::rename(unfinished_.c_str(), file_.c_str()) != 0) {
    fail();
  }
  std::fclose(stream_);
  stream_ = nullptr;
}

void OutputFile::fail() const {
  throw OutputError(file_, std::strerror(errno));
}

}  // namespace tracing
