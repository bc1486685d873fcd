// SPDX-License-Identifier: Apache-2.0
// How long something took, as its quantiles, and values drawn from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace tracing::twin {

// At most kMost values, in ascending order: all that were recorded, or as many quantiles of them, the least and the
// greatest among them.
struct Distribution {
  static constexpr std::size_t kMost = 500;

  std::vector<std::int64_t> values;

  // Takes any number of values, in any order.
  static Distribution of(std::vector<std::int64_t> recorded);
  bool empty() const { return values.empty(); }
  // Nearest rank, as in reports; 0 without values.
  std::int64_t quantile(double part) const;
  bool operator==(const Distribution&) const = default;
};

// Draws each value once, in random order, then each once again, and so on. So a run as long as the recorded one has
// the same distribution, not a sample of it.
class Draw {
 public:
  // The distribution must outlive it.
  Draw(const Distribution& distribution, std::uint64_t seed) : values_(&distribution.values), random_(seed) {}
  std::int64_t next();  // 0 without values

 private:
  const std::vector<std::int64_t>* values_;
  std::mt19937_64 random_;
  std::vector<std::uint32_t> order_;
  std::size_t used_ = 0;
};

}  // namespace tracing::twin
