// SPDX-License-Identifier: Apache-2.0
// The figures of a recorded system beside those of its twin.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tracing/model/twin/figures.hpp"

namespace twin_program {

struct Comparison {
  tracing::twin::Figures recorded;
  tracing::twin::Figures simulated;               // the twin without changes
  std::optional<tracing::twin::Figures> changed;  // simulated, with the changes
  std::optional<tracing::twin::Figures> run;      // the twin, with the changes, as it was recorded
  bool run_is_changed = false;
  std::int64_t left_out_ns = 0;  // of the recording, at its begin: System::up_ns
};

// `top`: rows of each part, those with the longest times; 0: all.
std::string table_of(const Comparison& comparison, std::size_t top);
// One object: a list of rows, and the errors of the whole.
std::string json_of(const Comparison& comparison);

}  // namespace twin_program
