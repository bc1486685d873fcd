// SPDX-License-Identifier: Apache-2.0
// Sizes on the command line: bytes, or a number with K, M or G (1024, 1024² and 1024³ bytes).
#pragma once

#include <CLI/CLI.hpp>

namespace launch {

// Turns "64M" or "64m" into "67108864"; anything else is an error.
CLI::Validator size_in_bytes();

}  // namespace launch
