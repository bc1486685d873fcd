// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/kept_samples.hpp"

namespace tracing::compare {

// Marsaglia's xorshift.
std::uint64_t KeptSamples::random() {
  state_ ^= state_ << 13;
  state_ ^= state_ >> 7;
  state_ ^= state_ << 17;
  return state_;
}

void KeptSamples::add(std::int64_t value) {
  ++count_;
  if (place_ == 0) {
    chosen_ = stride_ == 1 ? 0 : random() % stride_;
  }
  if (place_ == chosen_) {
    values_.push_back(value);
  }
  if (++place_ < stride_) {
    return;
  }
  place_ = 0;
  if (values_.size() < kMost) {
    return;
  }
  for (std::size_t pair = 0; pair < kMost / 2; ++pair) {
    values_[pair] = values_[2 * pair + (random() >> 32 & 1)];
  }
  values_.resize(kMost / 2);
  stride_ *= 2;
}

}  // namespace tracing::compare
