// SPDX-License-Identifier: Apache-2.0
// Average, extremes and deviation of a sequence of numbers, in constant memory.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rclcpp::topic_statistics {

// The values are NaN if nothing was measured.
struct StatisticData {
  double average = std::nan("");
  double min = std::nan("");
  double max = std::nan("");
  double standard_deviation = std::nan("");  // population standard deviation
  uint64_t sample_count = 0;
};

// Welford's method. Not thread safe.
class MovingAverage {
 public:
  void add(double value) {
    ++count_;
    const double distance = value - average_;
    average_ += distance / static_cast<double>(count_);
    square_sum_ += distance * (value - average_);
    min_ = std::min(min_, value);
    max_ = std::max(max_, value);
  }

  StatisticData statistics() const {
    if (count_ == 0) {
      return {};
    }
    return {average_, min_, max_, std::sqrt(square_sum_ / static_cast<double>(count_)), count_};
  }

 private:
  uint64_t count_ = 0;
  double average_ = 0;
  double square_sum_ = 0;  // sum of the squared distances from the average
  double min_ = std::numeric_limits<double>::infinity();
  double max_ = -std::numeric_limits<double>::infinity();
};

}  // namespace rclcpp::topic_statistics
