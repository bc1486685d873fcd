// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/calculations/rate_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace launch {

namespace {

constexpr double kKilobyte = 1000.0;
constexpr double kMegabyte = 1000.0 * 1000.0;

// All sizes in the unit that suits the bytes per second.
std::string size_text(double bytes, double per_second) {
  if (per_second < kKilobyte) {
    return fmt::format("{:.0f} B", bytes);
  }
  return per_second < kMegabyte ? fmt::format("{:.2f} KB", bytes / kKilobyte)
                                : fmt::format("{:.2f} MB", bytes / kMegabyte);
}

std::string statistics_line(const RateStatistics::Summary& s) {
  return fmt::format("\tmin: {:.3f}s max: {:.3f}s std dev: {:.5f}s window: {}\n", s.least, s.most, s.deviation,
                     s.count);
}

double rate_of(const RateStatistics::Summary& periods) {
  return periods.mean > 0.0 ? 1.0 / periods.mean : 0.0;
}

// The first row has the titles. Empty if there is no other.
std::string table(const std::vector<std::array<std::string, 6>>& cells) {
  if (cells.size() < 2) {
    return {};
  }
  std::string text;
  std::size_t width = 0;
  for (std::size_t row = 0; row < cells.size(); ++row) {
    std::string line;
    for (std::size_t column = 0; column < cells[row].size(); ++column) {
      std::size_t size = 0;
      for (const auto& each : cells) {
        size = std::max(size, each[column].size());
      }
      line += column == 0 ? "" : "   ";
      line +=
          row == 0 ? fmt::format("{:^{}}", cells[row][column], size) : fmt::format("{:<{}}", cells[row][column], size);
    }
    width = std::max(width, line.size());
    text += line + "\n" + (row == 0 ? std::string(width, '=') + "\n" : "");
  }
  return text + "\n";
}

}  // namespace

void RateStatistics::add(double value) {
  values_.push_back(value);
  if (values_.size() > window_) {
    values_.pop_front();
  }
  is_new_ = true;
}

void RateStatistics::add_arrival(double now) {
  if (last_arrival_ && now >= *last_arrival_) {
    add(now - *last_arrival_);
  } else {
    values_.clear();
  }
  last_arrival_ = now;
}

std::optional<RateStatistics::Summary> RateStatistics::take_summary() {
  if (!std::exchange(is_new_, false) || values_.empty()) {
    return std::nullopt;
  }
  Summary summary;
  summary.count = values_.size();
  const auto count = static_cast<double>(values_.size());
  summary.mean = std::accumulate(values_.begin(), values_.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : values_) {
    squares += (value - summary.mean) * (value - summary.mean);
  }
  summary.deviation = std::sqrt(squares / count);
  const auto [least, most] = std::minmax_element(values_.begin(), values_.end());
  summary.least = *least;
  summary.most = *most;
  return summary;
}

void BandwidthStatistics::add(double now, std::size_t size) {
  messages_.emplace_back(now, size);
  if (messages_.size() > window_) {
    messages_.pop_front();
  }
  is_new_ = true;
}

std::optional<BandwidthStatistics::Summary> BandwidthStatistics::summary(double now) const {
  if (messages_.size() < 2 || now <= messages_.front().first) {
    return std::nullopt;
  }
  std::size_t total = 0;
  std::size_t least = messages_.front().second;
  std::size_t most = 0;
  for (const auto& [time, size] : messages_) {
    total += size;
    least = std::min(least, size);
    most = std::max(most, size);
  }
  return Summary{static_cast<double>(total) / (now - messages_.front().first),
                 static_cast<double>(total) / static_cast<double>(messages_.size()), static_cast<double>(least),
                 static_cast<double>(most), messages_.size()};
}

std::optional<BandwidthStatistics::Summary> BandwidthStatistics::take_summary(double now) {
  return std::exchange(is_new_, false) ? summary(now) : std::nullopt;
}

std::string rate_text(const RateStatistics::Summary& periods) {
  return fmt::format("average rate: {:.3f}\n", rate_of(periods)) + statistics_line(periods);
}

std::string delay_text(const RateStatistics::Summary& delays) {
  return fmt::format("average delay: {:.3f}\n", delays.mean) + statistics_line(delays);
}

std::string bandwidth_text(const BandwidthStatistics::Summary& messages) {
  const auto text = [&](double bytes) { return size_text(bytes, messages.per_second); };
  return fmt::format("{}/s from {} messages\n\tMessage size mean: {} min: {} max: {}\n", text(messages.per_second),
                     messages.count, text(messages.mean), text(messages.least), text(messages.most));
}

std::string rate_table(const std::vector<std::pair<std::string, RateStatistics::Summary>>& rows) {
  std::vector<std::array<std::string, 6>> cells = {{"topic", "rate", "min_delta", "max_delta", "std_dev", "window"}};
  for (const auto& [topic, s] : rows) {
    cells.push_back({topic, fmt::format("{:.3f}", rate_of(s)), fmt::format("{:.3f}", s.least),
                     fmt::format("{:.3f}", s.most), fmt::format("{:.5f}", s.deviation), fmt::to_string(s.count)});
  }
  return table(cells);
}

std::string bandwidth_table(const std::vector<std::pair<std::string, BandwidthStatistics::Summary>>& rows) {
  std::vector<std::array<std::string, 6>> cells = {{"topic", "bandwidth", "window", "mean", "min", "max"}};
  for (const auto& [topic, s] : rows) {
    const auto text = [&per_second = s.per_second](double bytes) { return size_text(bytes, per_second); };
    cells.push_back(
        {topic, text(s.per_second) + "/s", fmt::to_string(s.count), text(s.mean), text(s.least), text(s.most)});
  }
  return table(cells);
}

}  // namespace launch
