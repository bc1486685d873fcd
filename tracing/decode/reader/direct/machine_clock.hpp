// SPDX-License-Identifier: Apache-2.0
// The traces of other machines on the clock of the machine of the launch. The launch has measured how far the clocks
// are apart, and has written it into a file beside each trace: clock.json. Private to the reader.
#pragma once

#include <string>
#include <vector>

#include "tracing/decode/reader/direct/one_clock.hpp"

namespace tracing {

// Moves the times of each trace for which a clock.json in its directory or above it, not above the next verdict, says
// that they differ by more than the measurement can be wrong. Adds a sentence for each machine. The file may come from
// anywhere: one that says nothing sensible has no effect. The traces themselves stay as they are.
void put_on_clock_of_launch(const std::vector<ClockOfTrace>& traces, std::vector<std::string>& notes);

}  // namespace tracing
