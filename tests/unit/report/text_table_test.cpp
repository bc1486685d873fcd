// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/text_table.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

TEST(TextTable, AlignsLabelsLeftAndCellsRight) {
  const TextTable table(8, {6, 6});
  EXPECT_EQ(table.row("a", {"1", "22"}), "a            1    22\n");
  EXPECT_EQ(table.row("a", {"1"}), "a            1\n");
  EXPECT_EQ(table.row("a", {}), "a\n");
}

TEST(TextTable, GivesALongLabelALineOfItsOwn) {
  EXPECT_EQ(TextTable(4, {6}).row("/long_name", {"1"}), "/long_name\n         1\n");
}

}  // namespace
}  // namespace tracing
