// SPDX-License-Identifier: Apache-2.0
// Files that processes read, in a directory that only this user can enter and that ends with the launch.
#pragma once

#include <functional>
#include <string>

#include "launcher/process/process_spec.hpp"

namespace launch {

class GeneratedFiles {
 public:
  // `announce` is called with the path before the directory is made, and `withdraw` if it can't be made.
  void announce_to(std::function<void(const std::string& path)> announce, std::function<void()> withdraw) {
    announce_ = std::move(announce);
    withdraw_ = std::move(withdraw);
  }

  GeneratedFiles() = default;
  ~GeneratedFiles();  // removes the directory with all files
  GeneratedFiles(const GeneratedFiles&) = delete;
  GeneratedFiles& operator=(const GeneratedFiles&) = delete;

  // Writes the files of `spec` and puts their paths into its argv. The directory is made on first need, in the first of
  // $XDG_RUNTIME_DIR, $TMPDIR and /tmp that works. Throws std::system_error.
  void write(ProcessSpec& spec, ProcessId id);

  // Also for sockets and the like. Made on first need; throws std::system_error.
  const std::string& directory();

 private:
  bool make(const std::string& path);

  std::string directory_;
  std::function<void(const std::string&)> announce_;
  std::function<void()> withdraw_;
};

}  // namespace launch
