// SPDX-License-Identifier: Apache-2.0
// Text in columns, as the sections of details have it.
#pragma once

#include <string>
#include <vector>

#include "tracing/model/analysis/results.hpp"

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

// The columns of durations after a label: first their titles, then the cells of one row.
TextTable duration_table();
const std::vector<std::string>& duration_titles();
std::vector<std::string> duration_cells(const DurationSummary& took);

// "/ping, ping [71]"
std::string node_label(const std::string& node, ProcessIndex process, const TraceOverview& overview);

}  // namespace tracing
