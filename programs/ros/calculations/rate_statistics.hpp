// SPDX-License-Identifier: Apache-2.0
// What `launch topic hz`, `delay` and `bw` compute of the last messages, and how they print it. Times are seconds.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace launch {

class RateStatistics {
 public:
  struct Summary {
    double mean = 0.0, least = 0.0, most = 0.0, deviation = 0.0;
    std::size_t count = 0;
  };

  explicit RateStatistics(std::size_t window) : window_(window) {}

  void add(double value);
  // Adds the time since the arrival before, if there was one and the clock has not gone back.
  void add_arrival(double now);
  // None if nothing was added since the last call.
  std::optional<Summary> take_summary();

 private:
  std::size_t window_;
  std::deque<double> values_;
  std::optional<double> last_arrival_;
  bool is_new_ = false;
};

class BandwidthStatistics {
 public:
  explicit BandwidthStatistics(std::size_t window) : window_(window) {}

  struct Summary {
    double per_second = 0.0, mean = 0.0, least = 0.0, most = 0.0;  // bytes
    std::size_t count = 0;
  };

  void add(double now, std::size_t size);
  // None before the second message.
  std::optional<Summary> summary(double now) const;
  // The same, if a message was added since the last call.
  std::optional<Summary> take_summary(double now);

 private:
  std::size_t window_;
  std::deque<std::pair<double, std::size_t>> messages_;
  bool is_new_ = false;
};

std::string rate_text(const RateStatistics::Summary& periods);
std::string delay_text(const RateStatistics::Summary& delays);
std::string bandwidth_text(const BandwidthStatistics::Summary& messages);
// By topic. Empty without rows.
std::string rate_table(const std::vector<std::pair<std::string, RateStatistics::Summary>>& rows);
std::string bandwidth_table(const std::vector<std::pair<std::string, BandwidthStatistics::Summary>>& rows);

}  // namespace launch
