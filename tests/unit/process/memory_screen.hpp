// SPDX-License-Identifier: Apache-2.0
// A screen whose text a test can read back.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "base/files/unique_fd.hpp"

class MemoryScreen {
 public:
  MemoryScreen() : file_(::memfd_create("screen", MFD_CLOEXEC)) {}

  int fd() const { return file_.get(); }
  std::string text() const {
    const auto size = static_cast<std::size_t>(::lseek(file_.get(), 0, SEEK_END));
    std::string content(size, '\0');
    content.resize(static_cast<std::size_t>(::pread(file_.get(), content.data(), size, 0)));
    return content;
  }

 private:
  launch::UniqueFd file_;
};
