// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/text_table.hpp"

#include <fmt/format.h>

#include "tracing/model/findings/hosts.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/findings/result_labels.hpp"

namespace tracing {

std::string TextTable::row(const std::string& label, const std::vector<std::string>& cells) const {
  std::string text = label;
  if (label.size() > label_width_ && !cells.empty()) {
    text += fmt::format("\n{:{}}", "", label_width_);
  } else {
    text = fmt::format("{:{}}", label, label_width_);
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    text += fmt::format(" {:>{}}", cells[i], widths_[i] - 1);
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text + '\n';
}

std::string node_label(const std::string& node, ProcessIndex process, const TraceOverview& overview) {
  const std::string label = process < overview.processes.size() ? process_label(overview.processes[process]) : "?";
  return fmt::format("{}{}, {}", Hosts(overview).before(process), node.empty() ? "node unknown" : node, label);
}

TextTable duration_table() {
  constexpr std::size_t kDuration = 8;
  return {36, {8, kDuration, kDuration, kDuration, kDuration, kDuration, kDuration, kDuration}};
}

const std::vector<std::string>& duration_titles() {
  static const std::vector<std::string> titles{"count", "mean", "stddev", "min", "p50", "p90", "p99", "max"};
  return titles;
}

std::vector<std::string> duration_cells(const DurationSummary& took) {
  std::vector<std::string> cells{fmt::format("{}", took.count)};
  if (took.count == 0) {
    return cells;
  }
  cells.push_back(format_duration(took.mean_ns));
  cells.push_back(took.count == 1 ? "-" : format_duration(took.stddev_ns));
  for (const std::int64_t value : {took.min_ns, took.p50_ns, took.p90_ns, took.p99_ns, took.max_ns}) {
    cells.push_back(format_duration(static_cast<double>(value)));
  }
  return cells;
}

}  // namespace tracing
