// SPDX-License-Identifier: Apache-2.0
// Samples of one quantity in the order of time, in bounded memory.
//
// When there are too many, one of each two neighbours is dropped, chosen at random. What is left is spread evenly over
// the run and has the same distribution. The random numbers are the same in each run of the program.
#pragma once

#include <cstdint>
#include <vector>

namespace tracing::compare {

class KeptSamples {
 public:
  static constexpr std::size_t kMost = 256;

  void add(std::int64_t value);

  std::uint64_t count() const { return count_; }                       // of all samples
  const std::vector<std::int64_t>& values() const { return values_; }  // those that were kept

 private:
  std::uint64_t random();

  std::vector<std::int64_t> values_;
  std::uint64_t count_ = 0;
  std::uint64_t stride_ = 1;  // one of so many samples is kept
  std::uint64_t place_ = 0;   // of the next sample within these
  std::uint64_t chosen_ = 0;
  std::uint64_t state_ = 0x9e3779b97f4a7c15;
};

}  // namespace tracing::compare
