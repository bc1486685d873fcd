// SPDX-License-Identifier: Apache-2.0
#include "base/files/small_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "base/files/unique_fd.hpp"

namespace launch {

std::optional<std::string> read_small_file(const std::string& path) {
  const UniqueFd file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) {
    return std::nullopt;
  }
  std::string text;
  std::array<char, 4096> part{};
  while (true) {
    const ssize_t length = read(file.get(), part.data(), part.size());
    if (length == 0) {
      return text;
    }
    if (length > 0) {
      text.append(part.data(), static_cast<std::size_t>(length));
    } else if (errno != EINTR) {
      return std::nullopt;
    }
  }
}

}  // namespace launch
