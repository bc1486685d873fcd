// SPDX-License-Identifier: Apache-2.0
// A table that fits the width of a terminal and shows the rows that matter most.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

// A row, and what it can be sorted by. A negative value is unknown.
struct Row {
  std::string label;
  std::string remark{};  // shown behind the label if there is room
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
  ScreenTable(std::string title, std::vector<std::string> columns, std::string key)
      : title_(std::move(title)), columns_(std::move(columns)), key_(std::move(key)) {}

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

}  // namespace tracing
