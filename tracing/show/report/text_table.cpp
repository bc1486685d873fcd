// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tracing/model/findings/hosts.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/findings/result_labels.hpp"

namespace tracing {

namespace {

constexpr std::size_t kLeastLabel = 24;

struct SortKey {
  const char* name;
  double Row::*value;  // nullptr: the label
};
constexpr SortKey kSortKeys[] = {{"total", &Row::total}, {"count", &Row::count}, {"rate", &Row::rate},
                                 {"p50", &Row::p50},     {"p99", &Row::p99},     {"max", &Row::max},
                                 {"name", nullptr}};

}  // namespace

const std::vector<std::string>& sort_keys() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const SortKey& key : kSortKeys) {
      list.emplace_back(key.name);
    }
    return list;
  }();
  return names;
}

std::string styled(const std::string& text, Style style, bool color) {
  if (!color || style == Style::kPlain || text.empty()) {
    return text;
  }
  static constexpr int kCodes[] = {0, 1, 32, 31, 33, 2};  // in the order of Style
  return fmt::format("\033[{}m{}\033[0m", kCodes[static_cast<std::size_t>(style)], text);
}

std::string shortened(const std::string& text, std::size_t width) {
  if (text.size() <= width) {
    return text;
  }
  if (width <= 2) {
    return text.substr(0, width);
  }
  const std::size_t end = (width - 2) / 2;
  return text.substr(0, width - 2 - end) + ".." + text.substr(text.size() - end);
}

Cell time_cell(const DurationSummary& took, std::int64_t DurationSummary::*value, Style style) {
  return took.count == 0 ? Cell{"-"} : Cell{format_duration(static_cast<double>(took.*value)), style};
}

Cell count_cell(std::uint64_t count, Style style) {
  return count == 0 ? Cell{"-"} : Cell{fmt::format("{}", count), style};
}

Cell rate_cell(double rate_hz) {
  if (rate_hz == 0) {
    return {"-"};
  }
  // Some messages in a burst have a rate of their own.
  return rate_hz < 9999.5 ? Cell{fmt::format("{:.4g} Hz", rate_hz)} : Cell{fmt::format("{:.4g} kHz", rate_hz / 1000)};
}

Cell percent_cell(double part) {
  const Style style = part > 0.9 ? Style::kBad : part > 0.6 ? Style::kWarning : Style::kPlain;
  return {fmt::format("{:.2f} %", part * 100), style};
}

void sort_by(Row& row, const DurationSummary& took) {
  if (took.count == 0) {
    return;
  }
  row.count = static_cast<double>(took.count);
  row.total = took.mean_ns * row.count;
  row.p50 = static_cast<double>(took.p50_ns);
  row.p99 = static_cast<double>(took.p99_ns);
  row.max = static_cast<double>(took.max_ns);
}

std::string ScreenTable::text(const ReportOptions& options) const {
  if (rows_.empty()) {
    return "";
  }
  std::vector<const Row*> rows;
  for (const Row& row : rows_) {
    rows.push_back(&row);
  }
  const std::string& name = options.sort.empty() ? key_ : options.sort;
  for (const SortKey& key : kSortKeys) {
    if (key.name == name) {
      std::stable_sort(rows.begin(), rows.end(), [&key](const Row* a, const Row* b) {
        return key.value == nullptr ? a->label < b->label : a->*key.value > b->*key.value;
      });
    }
  }
  const std::size_t shown = options.top == 0 || options.all ? rows.size() : std::min(options.top, rows.size());

  std::vector<std::size_t> widths;
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    std::size_t width = columns_[column].size();
    for (std::size_t i = 0; i < shown; ++i) {
      if (column < rows[i]->cells.size()) {
        width = std::max(width, rows[i]->cells[column].text.size());
      }
    }
    widths.push_back(width + 2);
  }
  // The last columns give way to the labels.
  std::size_t used = 0;
  std::size_t fitting = 0;
  while (fitting < widths.size() && used + widths[fitting] + kLeastLabel <= options.width) {
    used += widths[fitting++];
  }
  const std::string title = shown == rows.size() ? title_ : fmt::format("{}, {} of {}", title_, shown, rows.size());
  std::size_t label_width = title.size();
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t remark = rows[i]->remark.empty() ? 0 : rows[i]->remark.size() + 2;
    label_width = std::max(label_width, rows[i]->label.size() + 2 + remark);
  }
  label_width = std::min(label_width, options.width - used);

  std::string header = fmt::format("{:{}}", title, label_width);
  for (std::size_t column = 0; column < fitting; ++column) {
    header += fmt::format("{:>{}}", columns_[column], widths[column]);
  }
  std::string text = "\n" + styled(header, Style::kBold, options.color) + "\n";
  for (std::size_t i = 0; i < shown; ++i) {
    const Row& row = *rows[i];
    std::string label = "  " + shortened(row.label, label_width - 2);
    std::size_t length = label.size();
    if (!row.remark.empty() && length + 2 + row.remark.size() <= label_width) {
      label += "  " + styled(row.remark, Style::kDim, options.color);
      length += 2 + row.remark.size();
    }
    std::string line = label;
    std::size_t blanks = label_width - length;
    for (std::size_t column = 0; column < fitting && column < row.cells.size(); ++column) {
      const Cell& cell = row.cells[column];
      blanks += widths[column] - cell.text.size();
      if (cell.text.empty()) {
        continue;
      }
      line += std::string(blanks, ' ') + styled(cell.text, cell.style, options.color);
      blanks = 0;
    }
    text += line + "\n";
    if (!row.below.empty()) {
      text += "    " + styled(shortened(row.below, options.width - 4), Style::kDim, options.color) + "\n";
    }
  }
  return text;
}

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

namespace {

template <auto kMember>
std::string measured(const DurationSummary& took) {
  return took.count == 0 ? "" : format_duration(static_cast<double>(took.*kMember));
}

TextTable duration_table() {
  return {kDurationLabel, std::vector<std::size_t>(kDurationColumns.size(), kDurationWidth)};
}

}  // namespace

const std::array<DurationColumn, 8> kDurationColumns{{
    {"count", [](const DurationSummary& took) { return std::to_string(took.count); }},
    {"mean", measured<&DurationSummary::mean_ns>},
    {"stddev",
     [](const DurationSummary& took) { return took.count == 1 ? "-" : measured<&DurationSummary::stddev_ns>(took); }},
    {"min", measured<&DurationSummary::min_ns>},
    {"p50", measured<&DurationSummary::p50_ns>},
    {"p90", measured<&DurationSummary::p90_ns>},
    {"p99", measured<&DurationSummary::p99_ns>},
    {"max", measured<&DurationSummary::max_ns>},
}};

std::string duration_header(const std::string& title) {
  std::vector<std::string> titles;
  for (const DurationColumn& column : kDurationColumns) {
    titles.emplace_back(column.title);
  }
  return duration_table().row(title, titles);
}

std::string duration_row(const std::string& label, const DurationSummary& took) {
  std::vector<std::string> cells;
  for (const DurationColumn& column : kDurationColumns) {
    cells.push_back(column.cell(took));
  }
  return duration_table().row(label, cells);
}

std::string time_text(const std::optional<std::int64_t>& ns) {
  return ns ? format_duration(static_cast<double>(*ns)) : "-";
}

}  // namespace tracing
