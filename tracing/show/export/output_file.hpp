// SPDX-License-Identifier: Apache-2.0
// A file that is complete or not there at all.
#pragma once

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace tracing {

class OutputError : public std::runtime_error {
 public:
  // "cannot write FILE: No space left on device"
  OutputError(const std::filesystem::path& file, const std::string& reason);
};

// Writes beside the file and renames at the end. What is no regular file is written directly, such as /dev/stdout,
// which is also `-`.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path file);
  ~OutputFile();  // removes the unfinished file
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  // To be called once, when everything is written.
  void finish();

  // The name to write to, for libraries that open files themselves.
  const std::filesystem::path& unfinished() const { return unfinished_; }

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path file_;
  std::filesystem::path unfinished_;
  std::FILE* stream_ = nullptr;
};

}  // namespace tracing
