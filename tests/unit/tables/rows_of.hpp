// SPDX-License-Identifier: Apache-2.0
// The rows of a table as texts.
#pragma once

#include <string>
#include <vector>

#include "tracing/show/tables/tables.hpp"

namespace tracing::testing {

// Each row as its cells, separated by |. With names: only these columns, in this order.
inline std::vector<std::string> rows_of(const TracedSystem& system, const std::string& name,
                                        const std::vector<std::string>& columns) {
  std::vector<std::string> rows;
  for (const Table& table : tables_of(system)) {
    if (table.name != name) {
      continue;
    }
    table.for_each_row([&](const Row& row) {
      std::string text;
      for (const std::string& wanted : columns) {
        text += text.empty() ? "" : "|";
        for (std::size_t i = 0; i < row.size(); ++i) {
          if (table.columns[i].name != wanted) {
            continue;
          }
          if (const auto* integer = std::get_if<std::int64_t>(&row[i])) {
            text += std::to_string(*integer);
          } else if (const auto* word = std::get_if<std::string_view>(&row[i])) {
            text += *word;
          } else if (const auto* real = std::get_if<double>(&row[i])) {
            text += std::to_string(*real);
          } else {
            text += "-";
          }
        }
      }
      rows.push_back(text);
    });
  }
  return rows;
}

}  // namespace tracing::testing
