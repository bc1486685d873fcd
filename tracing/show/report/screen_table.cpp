// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/screen_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tracing {

namespace {

constexpr std::size_t kLeastLabel = 24;

double value_of(const Row& row, const std::string& key) {
  if (key == "total") {
    return row.total;
  }
  if (key == "count") {
    return row.count;
  }
  if (key == "rate") {
    return row.rate;
  }
  if (key == "p50") {
    return row.p50;
  }
  if (key == "p99") {
    return row.p99;
  }
  return row.max;
}

}  // namespace

const std::vector<std::string>& sort_keys() {
  static const std::vector<std::string> keys{"total", "count", "rate", "p50", "p99", "max", "name"};
  return keys;
}

std::string styled(const std::string& text, Style style, bool color) {
  if (!color || style == Style::kPlain || text.empty()) {
    return text;
  }
  const char* code = "";
  switch (style) {
    case Style::kBold:
      code = "1";
      break;
    case Style::kGood:
      code = "32";
      break;
    case Style::kBad:
      code = "31";
      break;
    case Style::kWarning:
      code = "33";
      break;
    case Style::kDim:
      code = "2";
      break;
    case Style::kPlain:
      break;
  }
  return fmt::format("\033[{}m{}\033[0m", code, text);
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

std::string ScreenTable::text(const ReportOptions& options) const {
  if (rows_.empty()) {
    return "";
  }
  std::vector<const Row*> rows;
  for (const Row& row : rows_) {
    rows.push_back(&row);
  }
  const std::string& key = options.sort.empty() ? key_ : options.sort;
  if (!key.empty()) {
    std::stable_sort(rows.begin(), rows.end(), [&key](const Row* a, const Row* b) {
      return key == "name" ? a->label < b->label : value_of(*a, key) > value_of(*b, key);
    });
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
  }
  return text;
}

}  // namespace tracing
