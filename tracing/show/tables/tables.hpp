// SPDX-License-Identifier: Apache-2.0
// A trace as tables. This is the one declaration of what SQL, CSV and Python give, and of docs/tables.md.
//
// Tables refer to one another by the column `id`, which counts from 0. Columns whose names end with _ns are
// nanoseconds; points in time count from the epoch.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tracing/model/timeline/traced_system.hpp"

namespace tracing {

// Raised when a table or a column that exists comes to mean something else, or goes. New ones do not raise it.
inline constexpr std::int64_t kTablesVersion = 1;

// monostate: no value, which is NULL in SQL and empty in CSV. A text is valid until the next row.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string_view>;
using Row = std::vector<Cell>;
using Emit = std::function<void(const Row&)>;

enum class ColumnType { kInteger, kReal, kText };

struct Column {
  std::string name;
  ColumnType type = ColumnType::kInteger;
  std::string help;  // for docs/tables.md; empty: the name says it all
};

struct Table {
  std::string name;
  std::string help;
  std::vector<Column> columns;
  // Calls its argument for each row, with as many cells as there are columns.
  std::function<void(const Emit&)> for_each_row;
};

// The system must outlive the tables.
std::vector<Table> tables_of(const TracedSystem& system);

}  // namespace tracing
