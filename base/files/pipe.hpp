// SPDX-License-Identifier: Apache-2.0
// A pipe whose ends are close-on-exec: a program that this process starts has only the copies that it is given.
#pragma once

#include <string>

#include "base/files/unique_fd.hpp"

namespace launch {

struct Pipe {
  UniqueFd read;
  UniqueFd write;
};

// Throws std::system_error.
Pipe make_pipe();

// Reads a pipe or a file to its end and returns the text. A pipe ends when the last writer has closed its end, so the
// caller has to close its own copy of the write end before.
std::string read_to_end(const UniqueFd& fd);

}  // namespace launch
