// SPDX-License-Identifier: Apache-2.0
// Files that processes read, in a directory that only this user can enter and that ends with the launch.
#pragma once

#include <string>

#include "launcher/process/process_spec.hpp"

namespace launch {

class GeneratedFiles {
 public:
  GeneratedFiles() = default;
  ~GeneratedFiles();  // removes the directory with all files
  GeneratedFiles(const GeneratedFiles&) = delete;
  GeneratedFiles& operator=(const GeneratedFiles&) = delete;

  // Writes the files of `spec` and puts their paths into its argv. The directory is made on first need, in the first of
  // $XDG_RUNTIME_DIR, $TMPDIR and /tmp that works. Throws std::system_error.
  void write(ProcessSpec& spec, ProcessId id);

 private:
  const std::string& directory();

  std::string directory_;
};

}  // namespace launch
