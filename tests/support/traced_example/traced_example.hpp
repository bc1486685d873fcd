// SPDX-License-Identifier: Apache-2.0
// The example system of example_system.hpp, read and analysed.
#pragma once

#include <cstdint>

#include "tests/support/trace_writer/example_system.hpp"
#include "tracing/model/timeline/traced_system.hpp"

namespace tracing::testing {

// Its directory is "/traces/example".
TracedSystem traced_example(std::uint64_t cycles, ExampleEvents events = ExampleEvents::kRos);

}  // namespace tracing::testing
