// SPDX-License-Identifier: Apache-2.0
#include "base/files/pipe.hpp"

#include <fcntl.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace launch {

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::system_category(), "cannot create a pipe");
  }
  return {UniqueFd(ends[0]), UniqueFd(ends[1])};
}

std::string read_to_end(const UniqueFd& fd) {
  std::string text;
  std::array<char, 4096> buffer;
  while (true) {
    const ssize_t count = ::read(fd.get(), buffer.data(), buffer.size());
    if (count > 0) {
      text.append(buffer.data(), static_cast<std::size_t>(count));
    } else if (count == 0 || errno != EINTR) {
      return text;
    }
  }
}

}  // namespace launch
