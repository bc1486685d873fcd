// SPDX-License-Identifier: Apache-2.0
// How long something took: as its quantiles, and when which of them was recorded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace tracing::twin {

// How long something took, and when that began.
struct Sample {
  std::int64_t time_ns = 0;
  std::int64_t value = 0;
};

// At most kMost values: all that were recorded, or as many quantiles of them, the least and the greatest among them.
struct Distribution {
  static constexpr std::size_t kMost = 500;
  struct Moment {
    std::int64_t time_ns = 0;
    std::uint32_t place = 0;  // of the value that was recorded then, or of the quantile next to it
  };

  std::vector<std::int64_t> values;  // as recorded: in ascending order
  std::vector<Moment> moments;       // in the order of time; empty if the times are not known

  // Take any number of values, in any order.
  static Distribution of(std::vector<std::int64_t> recorded);
  static Distribution of(std::vector<Sample> recorded);
  bool empty() const { return values.empty(); }
  // Those that were recorded from this time on, in ascending order; all if their times are not known.
  std::vector<std::int64_t> values_from(std::int64_t time_ns) const;
  // Nearest rank, as in reports; 0 without values.
  std::int64_t quantile(double part) const;
  bool operator==(const Distribution& other) const { return values == other.values; }
};

// The time that a recording is played again and again: its begin, and how long it is.
struct Cycle {
  std::int64_t begin_ns = 0;
  std::int64_t length_ns = 0;
  // How far the next value may be from its time, in usual intervals, before the nearest one is taken instead.
  double slack = 1;
};

// Draws values in random order, or as they were recorded one after the other.
class Draw {
 public:
  struct Drawn {
    std::int64_t value = 0;
    std::uint32_t place = 0;  // in Distribution::values
  };

  // The distribution must outlive it.
  Draw(const Distribution& distribution, std::uint64_t seed, Cycle cycle = {})
      : distribution_(&distribution), random_(seed), cycle_(cycle) {}
  // Each value once, in random order, then each once again, and so on. So a run as long as the recorded one has the
  // same distribution, not a sample of it. 0 without values.
  std::int64_t next() { return at_random().value; }
  // What was recorded at this time after the begin of the cycle: the one that follows the one before, or, if that was
  // at another time, the nearest one. So what held up the whole machine holds up all callbacks at the same time. As
  // next() if the times are not known.
  Drawn next_at(std::int64_t time_ns);

 private:
  Drawn at_random();

  const Distribution* distribution_;
  std::mt19937_64 random_;
  Cycle cycle_;
  std::int64_t round_ = -1;    // of the cycle
  std::size_t following_ = 0;  // a moment of this round
  std::vector<std::uint32_t> order_;
  std::size_t used_ = 0;
};

}  // namespace tracing::twin
