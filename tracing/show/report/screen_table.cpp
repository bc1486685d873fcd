// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/screen_table.hpp"

#include <fmt/format.h>

#include <algorithm>

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
  }
  return text;
}

}  // namespace tracing
