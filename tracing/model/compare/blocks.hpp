// SPDX-License-Identifier: Apache-2.0
// Cuts the samples of two runs into blocks whose values are nearly independent (the method of batch means).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace tracing::compare {

// The blocks of two runs, which have equal lengths, and how much each run differs within itself.
struct BlockPair {
  std::vector<double> before;
  std::vector<double> after;
  double own_spread = 0;  // the larger one of both runs, nanoseconds
};

inline constexpr std::size_t kLeastBlocks = 10;  // fewer can't show anything once there are many tests

// `share`: the quantile that is the value of a block. `least_length`: samples of a block, at least. nullopt when a run
// has too few samples.
std::optional<BlockPair> cut_into_blocks(const std::vector<std::int64_t>& before,
                                         const std::vector<std::int64_t>& after, double share,
                                         std::size_t least_length);

}  // namespace tracing::compare
