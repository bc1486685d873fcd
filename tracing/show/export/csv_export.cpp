// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tracing/show/export/csv_text.hpp"
#include "tracing/show/export/export.hpp"
#include "tracing/show/export/output_file.hpp"
#include "tracing/show/tables/tables.hpp"

namespace tracing {

namespace {

void write_table(const Table& table, const std::filesystem::path& path) {
  OutputFile file(path);
  std::string line;
  for (const Column& column : table.columns) {
    if (!line.empty()) {
      line += ',';
    }
    line += column.name;
  }
  file.write(line + "\n");
  table.for_each_row([&](const Row& row) {
    line.clear();
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) {
        line += ',';
      }
      if (const auto* integer = std::get_if<std::int64_t>(&row[i])) {
        fmt::format_to(std::back_inserter(line), "{}", *integer);
      }
      if (const auto* real = std::get_if<double>(&row[i])) {
        fmt::format_to(std::back_inserter(line), "{}", *real);
      }
      if (const auto* text = std::get_if<std::string_view>(&row[i])) {
        append_csv_text(line, *text);
      }
    }
    line += '\n';
    file.write(line);
  });
  file.finish();
}

}  // namespace

void export_csv(const TracedSystem& system, const std::filesystem::path& directory) {
  std::error_code failed;
  std::filesystem::create_directories(directory, failed);
  if (failed) {
    throw OutputError(directory, failed.message());
  }
  for (const Table& table : tables_of(system)) {
    write_table(table, directory / fmt::format("{}.csv", table.name));
  }
}

}  // namespace tracing
