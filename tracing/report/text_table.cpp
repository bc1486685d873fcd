// SPDX-License-Identifier: Apache-2.0
#include "tracing/report/text_table.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>

namespace tracing {

std::string TextTable::row(const std::string& label, const std::vector<std::string>& cells) const {
  std::string text = label;
  if (label.size() > label_width_ && !cells.empty())
    text += fmt::format("\n{:{}}", "", label_width_);
  else
    text = fmt::format("{:{}}", label, label_width_);
  for (std::size_t i = 0; i < cells.size(); ++i) text += fmt::format(" {:>{}}", cells[i], widths_[i] - 1);
  text.erase(text.find_last_not_of(' ') + 1);
  return text + '\n';
}

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

}  // namespace tracing
