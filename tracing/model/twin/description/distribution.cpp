// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/description/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
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

Distribution Distribution::of(std::vector<Sample> recorded) {
  std::stable_sort(recorded.begin(), recorded.end(),
                   [](const Sample& left, const Sample& right) { return left.value < right.value; });
  std::vector<std::int64_t> values;
  values.reserve(recorded.size());
  for (const Sample& sample : recorded) {
    values.push_back(sample.value);
  }
  Distribution distribution = of(std::move(values));
  const std::size_t kept = distribution.values.size();
  distribution.moments.reserve(recorded.size());
  for (std::size_t rank = 0; rank < recorded.size(); ++rank) {
    distribution.moments.push_back({recorded[rank].time_ns, static_cast<std::uint32_t>(rank * kept / recorded.size())});
  }
  std::stable_sort(distribution.moments.begin(), distribution.moments.end(),
                   [](const Moment& left, const Moment& right) { return left.time_ns < right.time_ns; });
  return distribution;
}

std::vector<std::int64_t> Distribution::values_from(std::int64_t time_ns) const {
  if (moments.empty()) {
    return values;
  }
  std::vector<std::int64_t> from;
  for (const Moment& moment : moments) {
    if (moment.time_ns >= time_ns) {
      from.push_back(values[moment.place]);
    }
  }
  std::sort(from.begin(), from.end());
  return from;
}

std::int64_t Distribution::quantile(double part) const {
  if (values.empty()) {
    return 0;
  }
  const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

Draw::Drawn Draw::next_at(std::int64_t time_ns) {
  const std::vector<Distribution::Moment>& moments = distribution_->moments;
  if (moments.empty() || cycle_.length_ns <= 0) {
    return at_random();
  }
  if (const std::int64_t round = time_ns / cycle_.length_ns; round != round_) {
    round_ = round;
    following_ = 0;
  }
  const std::int64_t wanted_ns = cycle_.begin_ns + time_ns % cycle_.length_ns;
  const auto distance = [&](std::size_t moment) { return std::abs(moments[moment].time_ns - wanted_ns); };
  const std::int64_t usual_ns =
      (moments.back().time_ns - moments.front().time_ns) / static_cast<std::int64_t>(moments.size());
  std::size_t chosen = following_;
  if (chosen >= moments.size() ||
      static_cast<double>(distance(chosen)) > cycle_.slack * static_cast<double>(usual_ns)) {
    const auto behind = std::lower_bound(
        moments.begin(), moments.end(), wanted_ns,
        [](const Distribution::Moment& moment, std::int64_t wanted) { return moment.time_ns < wanted; });
    chosen = std::min<std::size_t>(static_cast<std::size_t>(behind - moments.begin()), moments.size() - 1);
    if (chosen > 0 && distance(chosen - 1) < distance(chosen)) {
      --chosen;
    }
    if (distance(chosen) > 2 * usual_ns) {
      return at_random();
    }
  }
  following_ = chosen + 1;
  const std::uint32_t place = moments[chosen].place;
  return {distribution_->values[place], place};
}

Draw::Drawn Draw::at_random() {
  const std::vector<std::int64_t>& values = distribution_->values;
  if (values.empty()) {
    return {};
  }
  if (used_ == order_.size()) {
    order_.resize(values.size());
    std::iota(order_.begin(), order_.end(), 0u);
    // std::shuffle gives other orders with other standard libraries.
    for (std::size_t left = order_.size(); left > 1; --left) {
      std::swap(order_[left - 1], order_[random_() % left]);
    }
    used_ = 0;
  }
  const std::uint32_t place = order_[used_++];
  return {values[place], place};
}

}  // namespace tracing::twin
