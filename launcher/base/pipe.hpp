// SPDX-License-Identifier: Apache-2.0
// A pipe whose ends are closed in every program that this process starts, but for the copies that a child is given.
#pragma once

#include <string>

#include "launcher/base/unique_fd.hpp"

namespace launch {

struct Pipe {
  UniqueFd read;
  UniqueFd write;
};

// Throws std::system_error.
Pipe make_pipe();

// Waits for the end of what comes from a pipe or a file and returns it. It ends when the last writer has closed its
// end: the own copy has to be closed before.
std::string read_to_end(const UniqueFd& fd);

}  // namespace launch
