// SPDX-License-Identifier: Apache-2.0
// The process of a <clock>, which publishes simulated time and obeys lines of its standard input: `stop` and `go`,
// `scale FACTOR` of its rate, `jump SECONDS`.
#pragma once

#include "launcher/process/process_spec.hpp"

namespace launch {

inline bool is_clock(const ProcessSpec& spec) {
  return spec.argv.size() > 1 && spec.argv[0].ends_with("/launch-ros-command") && spec.argv[1] == "clock";
}

}  // namespace launch
