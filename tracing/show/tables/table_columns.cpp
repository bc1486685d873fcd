// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/tables/table_columns.hpp"

#include <limits>
#include <string_view>
#include <unordered_map>

namespace tracing {

namespace {

class Words {
 public:
  std::int32_t code_of(std::string_view word, std::vector<std::string>& words) {
    const auto [known, is_new] = codes_.try_emplace(std::string(word), static_cast<std::int32_t>(words.size()));
    if (is_new) {
      words.emplace_back(word);
    }
    return known->second;
  }

 private:
  std::unordered_map<std::string, std::int32_t> codes_;
};

void add(ColumnValues& values, Words& words, const Cell& cell, std::size_t row) {
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  const bool is_null = std::holds_alternative<std::monostate>(cell);
  if (is_null && values.is_null.empty()) {
    values.is_null.resize(row);
  }
  if (is_null || !values.is_null.empty()) {
    values.is_null.push_back(is_null ? 1 : 0);
  }
  switch (values.column.type) {
    case ColumnType::kInteger:
      values.integers.push_back(is_null ? 0 : std::get<std::int64_t>(cell));
      break;
    case ColumnType::kReal:
      values.reals.push_back(is_null ? kNoNumber : std::get<double>(cell));
      break;
    case ColumnType::kText:
      values.codes.push_back(is_null ? -1 : words.code_of(std::get<std::string_view>(cell), values.words));
      break;
  }
}

}  // namespace

TableColumns columns_of(const Table& table) {
  TableColumns result;
  result.name = table.name;
  for (const Column& column : table.columns) {
    result.columns.emplace_back().column = column;
  }
  std::vector<Words> words(table.columns.size());
  table.for_each_row([&](const Row& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      add(result.columns[i], words[i], row[i], result.rows);
    }
    ++result.rows;
  });
  return result;
}

}  // namespace tracing
