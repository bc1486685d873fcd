// SPDX-License-Identifier: Apache-2.0
// A trace as tables, which the exports to CSV and SQLite share. docs/analysis.md describes them.
//
// Tables refer to one another by the column `id`, which counts from 0. Columns whose names end with _ns are
// nanoseconds; points in time count from the epoch.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <variant>
#include <vector>

#include "tracing/model/timeline/traced_system.hpp"

namespace tracing {

// monostate: no value, which is NULL in SQL and empty in CSV. A text is valid until the next row.
using Cell = std::variant<std::monostate, std::int64_t, std::string_view>;
using Row = std::vector<Cell>;

struct Column {
  std::string_view name;
  bool is_text = false;
};

struct Table {
  std::string_view name;
  std::vector<Column> columns;
  // Calls its argument for each row, with as many cells as there are columns.
  std::function<void(const std::function<void(const Row&)>&)> for_each_row;
};

// The system must outlive the tables.
std::vector<Table> tables_of(const TracedSystem& system);

}  // namespace tracing
