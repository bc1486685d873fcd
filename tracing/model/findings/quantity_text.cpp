// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/findings/quantity_text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>

namespace tracing {

std::string format_duration(double nanoseconds) {
  static constexpr const char* kUnits[] = {"ns", "us", "ms", "s"};
  const char* sign = nanoseconds < 0 ? "-" : "";
  double value = std::abs(nanoseconds);
  std::size_t unit = 0;
  while (value >= 999.5 && unit + 1 < std::size(kUnits)) {  // it would be rounded to 1000
    value /= 1000;
    ++unit;
  }
  const bool whole = unit == 0 && value == std::floor(value);
  const int decimals = whole || value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
  return fmt::format("{}{:.{}f} {}", sign, value, decimals, kUnits[unit]);
}

std::string format_time(std::int64_t ns_since_epoch) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  std::int64_t seconds = ns_since_epoch / kSecond;
  std::int64_t rest = ns_since_epoch % kSecond;
  if (rest < 0) {
    rest += kSecond;
    --seconds;
  }
  return fmt::format("{:%Y-%m-%d %H:%M:%S}.{:06} UTC", fmt::gmtime(static_cast<std::time_t>(seconds)), rest / 1000);
}

std::string format_count(std::uint64_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : noun.ends_with('s') ? "es" : "s");
}

std::string format_size(std::uint64_t bytes) {
  if (bytes < 1000) {
    return fmt::format("{} bytes", bytes);
  }
  if (bytes < 1'000'000) {
    return fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3);
  }
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

}  // namespace tracing
