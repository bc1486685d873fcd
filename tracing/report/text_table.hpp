// SPDX-License-Identifier: Apache-2.0
// Text in columns, and quantities as people read them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tracing {

inline constexpr std::size_t kReportWidth = 100;  // columns

// The first column is a label, left-aligned. The others are right-aligned and separated by at least one blank. A label
// that is too long gets a line of its own, so that nothing is cut and the columns stay straight.
class TextTable {
 public:
  TextTable(std::size_t label_width, std::vector<std::size_t> widths)
      : label_width_(label_width), widths_(std::move(widths)) {}

  // `cells` has as many cells as there are widths, or fewer. The line ends with a newline, without trailing blanks.
  std::string row(const std::string& label, const std::vector<std::string>& cells) const;

 private:
  std::size_t label_width_;
  std::vector<std::size_t> widths_;
};

// Three digits and a unit: "999 ns", "1.23 us", "45.6 ms", "107 s"; never more than 7 characters below 10,000 s.
std::string format_duration(double nanoseconds);

// "2026-01-01 00:00:00.123456 UTC"
std::string format_time(std::int64_t ns_since_epoch);

// "1 event", "2 events"
std::string format_count(std::uint64_t count, const std::string& noun);

}  // namespace tracing
