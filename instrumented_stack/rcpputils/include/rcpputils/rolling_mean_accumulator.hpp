// SPDX-License-Identifier: Apache-2.0
// The mean of the last values.
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

namespace rcpputils {

template <typename T>
class RollingMeanAccumulator {
 public:
  // `rolling_window_size` is the number of values that count. It must not be 0.
  explicit RollingMeanAccumulator(size_t rolling_window_size) : values_(rolling_window_size, T{}) {}

  void accumulate(T value) {
    sum_ += value - values_[next_];
    values_[next_] = value;
    next_ = (next_ + 1) % values_.size();
    if (count_ < values_.size()) {
      ++count_;
    }
  }

  // There must be a value.
  T getRollingMean() const {
    assert(count_ > 0);
    return sum_ / static_cast<T>(count_);
  }

 private:
  std::vector<T> values_;
  size_t next_ = 0;
  size_t count_ = 0;
  T sum_{};
};

}  // namespace rcpputils
