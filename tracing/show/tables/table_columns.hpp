// SPDX-License-Identifier: Apache-2.0
// A table as columns in memory, for those who compute with whole columns.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/show/tables/tables.hpp"

namespace tracing {

// The values of one column. Of the lists of values one is used, as the type says; a cell without a value is 0 or NaN
// there.
struct ColumnValues {
  Column column;
  std::vector<std::int64_t> integers;
  std::vector<double> reals;
  std::vector<std::int32_t> codes;    // of texts: index in `words`, -1 without a value
  std::vector<std::string> words;     // in the order in which they come first
  std::vector<std::uint8_t> is_null;  // one for each row; empty: no cell is without a value
};

struct TableColumns {
  std::string name;
  std::size_t rows = 0;
  std::vector<ColumnValues> columns;
};

TableColumns columns_of(const Table& table);

}  // namespace tracing
