// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/description/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace tracing::twin {

Distribution Distribution::of(std::vector<std::int64_t> recorded) {
  std::sort(recorded.begin(), recorded.end());
  if (recorded.size() <= kMost) {
    return {std::move(recorded)};
  }
  Distribution distribution;
  distribution.values.reserve(kMost);
  for (std::size_t i = 0; i < kMost; ++i) {
    distribution.values.push_back(recorded[i * (recorded.size() - 1) / (kMost - 1)]);
  }
  return distribution;
}

std::int64_t Distribution::quantile(double part) const {
  if (values.empty()) {
    return 0;
  }
  const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

std::int64_t Draw::next() {
  if (values_->empty()) {
    return 0;
  }
  if (used_ == order_.size()) {
    order_.resize(values_->size());
    std::iota(order_.begin(), order_.end(), 0u);
    // std::shuffle gives other orders with other standard libraries.
    for (std::size_t left = order_.size(); left > 1; --left) {
      std::swap(order_[left - 1], order_[random_() % left]);
    }
    used_ = 0;
  }
  return (*values_)[order_[used_++]];
}

}  // namespace tracing::twin
