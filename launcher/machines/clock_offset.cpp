// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/clock_offset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace launch {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::size_t kMostWindows = 64;
constexpr std::int64_t kLeastTime = 10 * kSecond;  // to tell a drift
// Before the year 1970 and after 2070 there is no clock to compare with.
constexpr std::int64_t kLastTime = 100LL * 366 * 24 * 3600 * kSecond;

bool is_possible(const ClockReading& reading) {
  return reading.epoch_ns >= 0 && reading.epoch_ns <= kLastTime && reading.monotonic_ns >= 0 &&
         reading.monotonic_ns <= kLastTime;
}

// A line, by its values at the first and at the last moment.
struct Line {
  double first = 0;
  double last = 0;
};

// The lines that pass below (`sign` 1) or above (-1) a value at a moment, `share` of the way from first to last: what
// is left of a convex set, by its corners.
std::vector<Line> cut(const std::vector<Line>& corners, double share, double value, double sign) {
  const auto beyond = [&](const Line& line) { return sign * (line.first * (1 - share) + line.last * share - value); };
  std::vector<Line> left;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Line& from = corners[i];
    const Line& to = corners[(i + 1) % corners.size()];
    const double a = beyond(from);
    const double b = beyond(to);
    if (a <= 0) {
      left.push_back(from);
    }
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
      const double part = a / (a - b);
      left.push_back({from.first + part * (to.first - from.first), from.last + part * (to.last - from.last)});
    }
  }
  return left;
}

}  // namespace

ClockReading read_clocks() {
  const auto nanoseconds = [](auto now) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now.time_since_epoch()).count();
  };
  constexpr int kTries = 3;
  ClockReading best;
  std::int64_t shortest = kSecond;
  for (int i = 0; i < kTries; ++i) {
    const std::int64_t before = nanoseconds(std::chrono::steady_clock::now());
    const std::int64_t epoch = nanoseconds(std::chrono::system_clock::now());
    const std::int64_t after = nanoseconds(std::chrono::steady_clock::now());
    if (i == 0 || after - before < shortest) {
      shortest = after - before;
      best = {.epoch_ns = epoch, .monotonic_ns = before + shortest / 2};
    }
  }
  return best;
}

void ClockOffset::take_answer(std::int64_t sent_ns, const ClockReading& there) {
  const std::int64_t now =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
  ClockReading here = read_clocks();
  here = {.epoch_ns = here.epoch_ns - (here.monotonic_ns - now), .monotonic_ns = now};
  if (sent_ns > 0 && sent_ns <= here.monotonic_ns) {
    add(here.monotonic_ns - sent_ns, here, there);
  }
}

void ClockOffset::add(std::int64_t round_trip_ns, const ClockReading& here, const ClockReading& there) {
  if (round_trip_ns < 0 || round_trip_ns > 60 * kSecond || here.monotonic_ns < round_trip_ns || !is_possible(here) ||
      !is_possible(there)) {
    return;
  }
  ++count_;
  if (!keeps_epoch_) {
    epoch_here_ = here.epoch_ns - here.monotonic_ns;
    epoch_there_ = there.epoch_ns - there.monotonic_ns;
  }
  const std::int64_t middle = here.monotonic_ns - round_trip_ns / 2;
  const Sample sample{middle, there.monotonic_ns - middle, round_trip_ns};
  if (!samples_.empty() && samples_.back().at / window_ == middle / window_) {
    if (round_trip_ns < samples_.back().round_trip) {
      samples_.back() = sample;
    }
    return;
  }
  if (samples_.size() == kMostWindows) {
    window_ *= 2;
    std::vector<Sample> half;
    for (const Sample& each : samples_) {
      if (half.empty() || half.back().at / window_ != each.at / window_) {
        half.push_back(each);
      } else if (each.round_trip < half.back().round_trip) {
        half.back() = each;
      }
    }
    samples_ = std::move(half);
  }
  samples_.push_back(sample);
}

std::optional<ClockOffset::Measured> ClockOffset::measured() const {
  if (samples_.empty()) {
    return std::nullopt;
  }
  const Sample& best = *std::min_element(samples_.begin(), samples_.end(),
                                         [](const Sample& a, const Sample& b) { return a.round_trip < b.round_trip; });
  Measured measured{.at_ns = best.at,
                    .offset_ns = best.offset,
                    .epoch_ns = epoch_here_,
                    .shortest_ns = best.round_trip,
                    .round_trips = count_};
  if (!fit_line(best, measured)) {
    // One moment, or a clock whose pace has changed.
    for (const Sample& each : samples_) {
      measured.uncertainty_ns =
          std::max(measured.uncertainty_ns, std::abs(each.offset - best.offset) + (each.round_trip + 1) / 2);
    }
  }
  measured.wall_offset_ns = measured.offset_ns + epoch_there_ - epoch_here_;
  return measured;
}

bool ClockOffset::fit_line(const Sample& best, Measured& measured) const {
  const std::int64_t begin = samples_.front().at;
  const std::int64_t span = samples_.back().at - begin;
  if (span <= 0) {
    return false;
  }
  const auto middle = [&](const Sample& sample) { return static_cast<double>(sample.offset - best.offset); };
  const auto half = [](const Sample& sample) { return static_cast<double>(sample.round_trip + 1) / 2; };
  const Sample& first = samples_.front();
  const Sample& last = samples_.back();
  const Line lowest{middle(first) - half(first), middle(last) - half(last)};
  const Line highest{middle(first) + half(first), middle(last) + half(last)};
  std::vector<Line> possible = {lowest, {highest.first, lowest.last}, highest, {lowest.first, highest.last}};
  for (const Sample& sample : samples_) {
    const double share = static_cast<double>(sample.at - begin) / static_cast<double>(span);
    possible = cut(possible, share, middle(sample) + half(sample), 1);
    possible = cut(possible, share, middle(sample) - half(sample), -1);
  }
  if (possible.empty()) {
    return false;
  }
  // The one in the middle of what is possible; without a drift, if that is possible, too.
  Line least = possible.front();
  Line most = possible.front();
  for (const Line& corner : possible) {
    least = {std::min(least.first, corner.first), std::min(least.last, corner.last)};
    most = {std::max(most.first, corner.first), std::max(most.last, corner.last)};
  }
  Line line{(least.first + most.first) / 2, (least.last + most.last) / 2};
  double without_drift_least = middle(best) - half(best);
  double without_drift_most = middle(best) + half(best);
  for (const Sample& sample : samples_) {
    without_drift_least = std::max(without_drift_least, middle(sample) - half(sample));
    without_drift_most = std::min(without_drift_most, middle(sample) + half(sample));
  }
  if (without_drift_least <= without_drift_most) {
    line.first = line.last = (without_drift_least + without_drift_most) / 2;
  } else if (span < kLeastTime) {
    return false;
  }
  // An interval that is hit by chance must not make the result look better than a single round trip.
  const double error = std::max(
      {half(best), most.first - line.first, line.first - least.first, most.last - line.last, line.last - least.last});
  measured.at_ns = begin + span / 2;
  measured.offset_ns = best.offset + std::llround((line.first + line.last) / 2);
  measured.drift = (line.last - line.first) / static_cast<double>(span);
  measured.uncertainty_ns = static_cast<std::int64_t>(std::ceil(error)) + 1;
  return true;
}

std::string this_boot() {
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  std::string boot;
  file >> boot;
  return boot;
}

std::string clock_as_json(const std::string& machine, const ClockOffset::Measured& measured, const std::string& boot) {
  return fmt::format(
      "{{\n  \"machine\": \"{}\",\n  \"offset_ns\": {},\n  \"uncertainty_ns\": {},\n  \"drift\": {:.12f},\n"
      "  \"monotonic\": {{\"at_ns\": {}, \"offset_ns\": {}, \"epoch_ns\": {}, \"boot\": \"{}\"}},\n"
      "  \"shortest_round_trip_ns\": {},\n  \"round_trips\": {}\n}}\n",
      machine, measured.wall_offset_ns, measured.uncertainty_ns, measured.drift, measured.at_ns, measured.offset_ns,
      measured.epoch_ns, boot, measured.shortest_ns, measured.round_trips);
}

}  // namespace launch
