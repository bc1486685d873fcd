// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/tables/table_columns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tracing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(TableColumns, HoldValuesByTheirTypes) {
  const Table table{"t",
                    "",
                    {{"id"}, {"real", ColumnType::kReal, ""}, {"word", ColumnType::kText, ""}, {"maybe"}},
                    [](const Emit& emit) {
                      emit({std::int64_t{0}, 0.5, std::string_view("a"), std::int64_t{7}});
                      emit({std::int64_t{1}, {}, std::string_view("b"), {}});
                      emit({std::int64_t{2}, 1.5, std::string_view("a"), std::int64_t{9}});
                      emit({std::int64_t{3}, 2.5, {}, std::int64_t{9}});
                    }};
  const TableColumns columns = columns_of(table);
  EXPECT_EQ(columns.rows, 4u);
  EXPECT_THAT(columns.columns[0].integers, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(columns.columns[0].is_null, IsEmpty());
  EXPECT_THAT(columns.columns[1].reals, ElementsAre(0.5, ::testing::IsNan(), 1.5, 2.5));
  EXPECT_THAT(columns.columns[1].is_null, ElementsAre(0, 1, 0, 0));
  EXPECT_THAT(columns.columns[2].codes, ElementsAre(0, 1, 0, -1));
  EXPECT_THAT(columns.columns[2].words, ElementsAre("a", "b"));
  EXPECT_THAT(columns.columns[2].is_null, ElementsAre(0, 0, 0, 1));
  EXPECT_THAT(columns.columns[3].is_null, ElementsAre(0, 1, 0, 0));
}

}  // namespace
}  // namespace tracing
