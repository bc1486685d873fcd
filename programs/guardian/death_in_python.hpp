// SPDX-License-Identifier: Apache-2.0
// A launcher that Python of a launch file has ended: what to tell of it. Nobody else is left to do so.
#pragma once

#include <optional>
#include <string>

namespace launch {

struct DeathInPython {
  std::string error;  // as errors of launch files are told: place, line, caret
  bool by_launcher;   // the launcher has ended itself, because Python had reached a limit or closed its descriptors
};

// nullopt if Python has nothing to do with the end of the launcher. `records` is the memory file
// (guardian_protocol.hpp), `status` the wait status of the launcher.
std::optional<DeathInPython> death_in_python(int records, int status);

}  // namespace launch
