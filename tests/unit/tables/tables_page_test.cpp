// SPDX-License-Identifier: Apache-2.0
// docs/tables.md says what the declaration of the tables says. LAUNCH_UPDATE_GOLDEN=1 writes it anew.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "tests/support/traced_example/traced_example.hpp"
#include "tracing/show/tables/tables.hpp"

namespace tracing {
namespace {

// How many columns from `first` on are the parts of one distribution; 0: none.
std::size_t distribution_at(const std::vector<Column>& columns, std::size_t first) {
  const std::string& name = columns[first].name;
  const std::string end = "_count";
  if (!name.ends_with(end)) {
    return 0;
  }
  const std::string prefix = name.substr(0, name.size() - end.size());
  for (std::size_t part = 0; part < std::size(kDurationFields); ++part) {
    if (first + part >= columns.size() || columns[first + part].name != prefix + "_" + kDurationFields[part].name) {
      return 0;
    }
  }
  return std::size(kDurationFields);
}

std::string described(const Table& table) {
  std::string text = fmt::format("\n### {}\n\n", table.name);
  if (!table.help.empty()) {
    std::string help = table.help;
    help[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(help[0])));
    text += help + ".\n\n";
  }
  text += "| column | value |\n| --- | --- |\n";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    std::string help = column.name == "id" && column.help.empty() ? "counts from 0" : column.help;
    if (const std::size_t parts = distribution_at(table.columns, i)) {
      const std::string prefix = column.name.substr(0, column.name.size() - std::string("count").size());
      text +=
          fmt::format("| `{0}count` … `{0}max_ns` | a distribution{1}{2} |\n", prefix, help.empty() ? "" : ": ", help);
      i += parts - 1;
      continue;
    }
    text += fmt::format("| `{}` |{}{} |\n", column.name, help.empty() ? "" : " ", help);
  }
  return text;
}

TEST(TablesPage, DescribesEveryColumn) {
  const std::filesystem::path file = std::filesystem::path(DOCS) / "tables.md";
  std::ostringstream content;
  content << std::ifstream(file).rdbuf();
  const std::string text = content.str();
  const std::string begin = "<!-- From the declaration of the tables. -->\n";
  const std::string end = "\n<!-- End of the declaration. -->\n";
  const std::size_t from = text.find(begin) + begin.size();
  std::string tables;
  for (const Table& table : tables_of({})) {
    tables += described(table);
  }
  const std::string expected = text.substr(0, from) + tables + text.substr(text.find(end));
  if (std::getenv("LAUNCH_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(file) << expected;
    return;
  }
  EXPECT_EQ(text, expected) << "LAUNCH_UPDATE_GOLDEN=1 writes it anew";
}

TEST(Tables, HaveACellOfItsTypeForEachColumn) {
  const TracedSystem system = testing::traced_example(60, testing::ExampleEvents::kRosAndScheduler);
  std::set<std::string> names;
  for (const Table& table : tables_of(system)) {
    EXPECT_TRUE(names.insert(table.name).second) << table.name;
    std::set<std::string> columns;
    for (const Column& column : table.columns) {
      EXPECT_TRUE(columns.insert(column.name).second) << table.name << "." << column.name;
    }
    table.for_each_row([&](const Row& row) {
      ASSERT_EQ(row.size(), table.columns.size()) << table.name;
      for (std::size_t i = 0; i < row.size(); ++i) {
        const std::size_t expected[] = {1, 2, 3};  // in the order of ColumnType
        const std::size_t type = expected[static_cast<std::size_t>(table.columns[i].type)];
        EXPECT_TRUE(row[i].index() == 0 || row[i].index() == type) << table.name << "." << table.columns[i].name;
      }
    });
  }
}

}  // namespace
}  // namespace tracing
