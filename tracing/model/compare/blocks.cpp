// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/blocks.hpp"

#include <algorithm>
#include <cmath>

#include "tracing/model/compare/rank_test.hpp"

namespace tracing::compare {

namespace {

constexpr std::size_t kMostBlocks = 50;
constexpr std::size_t kTenBlocks = 10;  // fewer can't show anything once there are many tests
constexpr double kMostResemblance = 0.3;

std::vector<double> values_of_blocks(const std::vector<std::int64_t>& samples, double share, std::size_t length) {
  std::vector<double> values;
  std::vector<double> block;
  for (std::size_t begin = 0; begin + length <= samples.size(); begin += length) {
    const auto first = samples.begin() + static_cast<std::ptrdiff_t>(begin);
    block.assign(first, first + static_cast<std::ptrdiff_t>(length));
    values.push_back(quantile(block, share));
  }
  return values;
}

// How far the tenths of a run are apart, with and without the two highest and the lowest one. If a run drifts, or
// something disturbs it for a while, another run may differ from it by as much.
void compare_tenths(BlockPair& pair, const std::vector<std::int64_t>& samples, const BlockRule& rule) {
  std::vector<double> tenths = values_of_blocks(samples, rule.share, std::max(rule.least_length, samples.size() / 10));
  std::sort(tenths.begin(), tenths.end());
  const std::size_t lowest = tenths.size() / 10;
  const std::size_t highest = (tenths.size() * 8 + 9) / 10 - 1;
  pair.own_ratio = std::log(std::max(tenths[highest], 1.0) / std::max(tenths[lowest], 1.0));
  pair.own_range = std::log(std::max(tenths.back(), 1.0) / std::max(tenths.front(), 1.0));
}

}  // namespace

std::optional<BlockPair> cut_into_blocks(const std::vector<std::int64_t>& before,
                                         const std::vector<std::int64_t>& after, const BlockRule& rule) {
  const std::size_t fewer = std::min(before.size(), after.size());
  if (fewer < rule.least_blocks * rule.least_length) {
    return std::nullopt;
  }
  std::size_t length = std::max(rule.least_length, (fewer + kMostBlocks - 1) / kMostBlocks);
  BlockPair pair;
  while (true) {
    pair.before = values_of_blocks(before, rule.share, length);
    pair.after = values_of_blocks(after, rule.share, length);
    const double resemblance = std::max(rank_autocorrelation(pair.before), rank_autocorrelation(pair.after));
    if (resemblance <= kMostResemblance || fewer < kTenBlocks * length * 2) {
      break;
    }
    length *= 2;
  }
  compare_tenths(pair, before, rule);
  return pair;
}

}  // namespace tracing::compare
