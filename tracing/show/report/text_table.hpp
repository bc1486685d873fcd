// SPDX-License-Identifier: Apache-2.0
// Tables of the text report: one that fits a terminal and shows the rows that matter most, and text in columns, as the
// sections of details have it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tracing/model/analysis/results.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {

enum class Style { kPlain, kBold, kGood, kBad, kWarning, kDim };

// With the codes of a terminal, if `color`.
std::string styled(const std::string& text, Style style, bool color);

// At most `width` columns: what is too long loses its middle.
std::string shortened(const std::string& text, std::size_t width);

struct Cell {
  std::string text;
  Style style = Style::kPlain;
};

// "-" where there is nothing.
Cell time_cell(const DurationSummary& took, std::int64_t DurationSummary::*value, Style style = Style::kPlain);
Cell count_cell(std::uint64_t count, Style style = Style::kPlain);
Cell rate_cell(double rate_hz);
// A share of a processor; what is close to all of it stands out.
Cell percent_cell(double part);

// A row, and what it can be sorted by. A negative value is unknown.
struct Row {
  std::string label;
  std::string remark{};  // shown behind the label if there is room
  std::string below{};   // a line below the row: what tells it from others of the same label
  std::vector<Cell> cells{};
  double total = -1;
  double count = -1;
  double rate = -1;
  double p50 = -1;
  double p99 = -1;
  double max = -1;
};

class ScreenTable {
 public:
  // `key`: what the rows are sorted by unless the user says otherwise; one of sort_keys(), or empty: as they were
  // added.
  ScreenTable(std::string title, std::string key) : title_(std::move(title)), key_(std::move(key)) {}

  void add_column(std::string title) { columns_.push_back(std::move(title)); }
  void add(Row row) { rows_.push_back(std::move(row)); }

  // Begins with an empty line; empty without rows.
  std::string text(const ReportOptions& options) const;

 private:
  std::string title_;
  std::vector<std::string> columns_;
  std::string key_;
  std::vector<Row> rows_;
};

// Sorts the row by these times.
void sort_by(Row& row, const DurationSummary& took);

// A row for each result, and what a result has in each column. As ScreenTable, with the columns declared one by one.
template <class Result>
class ResultTable {
 public:
  using CellOf = std::function<Cell(const Result&)>;
  using Durations = DurationSummary Result::*;

  // As of ScreenTable.
  ResultTable(const char* title, const char* key) : table_(title, key) {}

  void column(const char* title, CellOf cell) {
    table_.add_column(title);
    cells_.push_back(std::move(cell));
  }
  void count(const char* title, std::uint64_t Result::*count, Style style = Style::kPlain) {
    column(title, [=](const Result& result) { return count_cell(result.*count, style); });
  }
  void time(const char* title, Durations took, std::int64_t DurationSummary::*value, Style style = Style::kPlain) {
    column(title, [=](const Result& result) { return time_cell(result.*took, value, style); });
  }
  void times(Durations took, Style p99_style = Style::kPlain) {
    time("p50", took, &DurationSummary::p50_ns);
    time("p99", took, &DurationSummary::p99_ns, p99_style);
    time("max", took, &DurationSummary::max_ns);
  }

  void add(Row row, const Result& result) {
    for (const CellOf& cell : cells_) {
      row.cells.push_back(cell(result));
    }
    table_.add(std::move(row));
  }
  std::string text(const ReportOptions& options) const { return table_.text(options); }

 private:
  std::vector<CellOf> cells_;
  ScreenTable table_;
};

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

inline constexpr std::size_t kDurationLabel = 36;
inline constexpr std::size_t kDurationWidth = 8;
struct DurationColumn {
  const char* title;
  std::string (*cell)(const DurationSummary& took);  // empty if nothing was measured
};
extern const std::array<DurationColumn, 8> kDurationColumns;

// The columns of durations after a label: first their titles below a title, then the cells of one row.
std::string duration_header(const std::string& title);
std::string duration_row(const std::string& label, const DurationSummary& took);

// A section of the details: a table with a row for each result.
template <class Result>
struct Section {
  using Text = std::function<std::string(const Result&)>;
  struct Column {
    const char* title;
    std::size_t width;
    Text cell;
  };

  std::string title;
  std::size_t label_width;
  std::vector<Column> columns;
  Text label;
  Text group = {};       // a line above the rows that have it in common
  Text more = {};        // lines below the row
  std::string end = {};  // the last lines

  // Begins with an empty line; empty without results.
  std::string text(const std::vector<Result>& results) const;
};

// Cells of a section: a number, and a time, "-" if there is none.
template <class Result, class Number>
auto number_of(Number Result::*member) {
  return [member](const Result& result) { return std::to_string(result.*member); };
}
std::string time_text(const std::optional<std::int64_t>& ns);
template <class Result, class Time>
auto time_of(Time Result::*member) {
  return [member](const Result& result) { return time_text(result.*member); };
}

// The columns of a section that shows durations.
template <class Result>
std::vector<typename Section<Result>::Column> duration_columns(DurationSummary Result::*took) {
  std::vector<typename Section<Result>::Column> columns;
  for (const DurationColumn& column : kDurationColumns) {
    columns.push_back({column.title, kDurationWidth,
                       [took, cell = column.cell](const Result& result) { return cell(result.*took); }});
  }
  return columns;
}

// "/ping, ping [71]"
std::string node_label(const std::string& node, ProcessIndex process, const TraceOverview& overview);

template <class Result>
std::string Section<Result>::text(const std::vector<Result>& results) const {
  if (results.empty()) {
    return "";
  }
  std::vector<std::size_t> widths;
  std::vector<std::string> titles;
  for (const Column& column : columns) {
    widths.push_back(column.width);
    titles.emplace_back(column.title);
  }
  const TextTable table(label_width, widths);
  std::string text = "\n" + table.row(title, titles);
  std::string last_group;
  for (const Result& result : results) {
    if (const std::string line = group ? group(result) : std::string(); line != last_group) {
      text += line + "\n";
      last_group = line;
    }
    std::vector<std::string> cells;
    for (const Column& column : columns) {
      cells.push_back(column.cell(result));
    }
    text += table.row(label(result), cells) + (more ? more(result) : "");
  }
  return text + end;
}

}  // namespace tracing
