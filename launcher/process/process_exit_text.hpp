// SPDX-License-Identifier: Apache-2.0
// How a process has ended, in words.
#pragma once

#include <string>

#include "launcher/process/process_spec.hpp"

namespace launch {

// "exit code 3", "SIGSEGV", "SIGSEGV, core dumped,".
std::string end_of(const ProcessExit& exit);

// "SIGSEGV, core dumped, after 12.41 s, with 3.10 s of processor time and 48.2 MiB"
std::string describe(const ProcessExit& exit);

}  // namespace launch
