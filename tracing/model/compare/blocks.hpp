// SPDX-License-Identifier: Apache-2.0
// Cuts the samples of two runs into blocks whose values are nearly independent (the method of batch means).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace tracing::compare {

// The blocks of two runs, which have equal lengths, and how much the tenths of the run before differ, as the natural
// logarithms of ratios.
struct BlockPair {
  std::vector<double> before;
  std::vector<double> after;
  double own_ratio = 0;  // of the third-highest and the second-lowest one
  double own_range = 0;  // of the highest and the lowest one
};

// How to cut. A run needs at least `least_blocks` of `least_length` samples.
struct BlockRule {
  double share = 0.5;  // the quantile that is the value of a block
  std::size_t least_length = 5;
  std::size_t least_blocks = 10;
};

// nullopt when a run has too few samples.
std::optional<BlockPair> cut_into_blocks(const std::vector<std::int64_t>& before,
                                         const std::vector<std::int64_t>& after, const BlockRule& rule);

}  // namespace tracing::compare
