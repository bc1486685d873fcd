// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/frontend/entity_test_support.hpp"

namespace launch {
namespace {

Scalar typed(std::string text) {
  return yaml11_scalar(LocatedText(std::move(text)));
}

TEST(Yaml11, ReadsIntegers) {
  const std::vector<std::pair<const char*, std::int64_t>> cases = {
      {"1", 1},
      {"01", 1},
      {"0x1F", 31},
      {"1_000", 1000},
      {"1:30", 90},
      {"010", 8},
      {"0b101", 5},
      {"-0x1f", -31},
      {"+7", 7},
      {"0", 0},
      {"-0", 0},
      {"190:20:30", 685230},
      {"0_7", 7},
      {"00", 0},
      {"-1:30", -90},
      {"9223372036854775807", INT64_MAX},
      {"-9223372036854775808", INT64_MIN},
  };
  for (const auto& [text, value] : cases) {
    const Scalar scalar = typed(text);
    EXPECT_EQ(scalar.type, Scalar::Type::kInt) << text;
    EXPECT_EQ(scalar.int_value, value) << text;
    EXPECT_EQ(scalar.text.text(), text);
  }
}

TEST(Yaml11, ReadsFloats) {
  const std::vector<std::pair<const char*, double>> cases = {
      {"1.", 1.0},
      {".5", 0.5},
      {"1.0e+3", 1000.0},
      {"-1.5", -1.5},
      {"+0.25", 0.25},
      {"1_0.5", 10.5},
      {"190:20:30.15", 685230.15},
      {"1.5E-1", 0.15},
      {".inf", std::numeric_limits<double>::infinity()},
      {"-.INF", -std::numeric_limits<double>::infinity()},
  };
  for (const auto& [text, value] : cases) {
    const Scalar scalar = typed(text);
    EXPECT_EQ(scalar.type, Scalar::Type::kFloat) << text;
    EXPECT_DOUBLE_EQ(scalar.float_value, value) << text;
  }
  EXPECT_TRUE(std::isnan(typed(".NaN").float_value));
}

TEST(Yaml11, ReadsBooleansAndNulls) {
  for (const char* text : {"yes", "On", "TRUE", "true"}) {
    EXPECT_EQ(typed(text).type, Scalar::Type::kBool) << text;
    EXPECT_TRUE(typed(text).bool_value) << text;
  }
  for (const char* text : {"no", "Off", "FALSE", "false"}) {
    EXPECT_EQ(typed(text).type, Scalar::Type::kBool) << text;
    EXPECT_FALSE(typed(text).bool_value) << text;
  }
  for (const char* text : {"", "~", "null", "Null", "NULL"}) {
    EXPECT_EQ(typed(text).type, Scalar::Type::kNull) << text;
  }
}

TEST(Yaml11, LeavesWhatYaml12WouldTypeAsText) {
  for (const char* text : {"1e3", "1.0e3", "0o17", "inf",  "nan",   "y",   "n",    "08",  "-.5",   "1:60",    "0:30",
                           "_1",  "0x",    "tRuE", "nULL", "1.2.3", "--1", "0x1G", "1 2", "-.nan", "$(var x)"}) {
    EXPECT_EQ(typed(text).type, Scalar::Type::kString) << text;
  }
}

TEST(Yaml11, ReadsATextToItsEnd) {
  for (const std::string& text : {std::string("1\0x", 3), std::string("1.5\0", 4), std::string("1:30\n")}) {
    EXPECT_EQ(typed(text).type, Scalar::Type::kString) << text;
  }
}

TEST(Yaml11, KnowsDatesAndNumbersThatFitNowhere) {
  for (const char* text : {"2024-01-01", "2024-1-1 1:00:00", "2024-01-01T10:00:00.5+01:00", "2001-12-14t21:59:43Z",
                           "9223372036854775808", "-9223372036854775809", "0x_"}) {
    EXPECT_EQ(typed(text).type, Scalar::Type::kOther) << text;
  }
  EXPECT_EQ(typed("2024-1-1").type, Scalar::Type::kString);
}

TEST(Yaml11, NamesTypesAsMessagesDo) {
  EXPECT_EQ(type_name(typed("a").type), "str");
  EXPECT_EQ(type_name(typed("1").type), "int");
  EXPECT_EQ(type_name(typed("1.0").type), "float");
  EXPECT_EQ(type_name(typed("on").type), "bool");
  EXPECT_EQ(type_name(typed("~").type), "null");
  EXPECT_EQ(type_name(typed("2024-01-01").type), "date");
}

TEST(Yaml11Value, ReadsScalarsAndLists) {
  EXPECT_EQ(yaml11_value(LocatedText("7")).scalar()->int_value, 7);
  EXPECT_EQ(yaml11_value(LocatedText("'7'")).scalar()->type, Scalar::Type::kString);
  EXPECT_EQ(yaml11_value(LocatedText("a # b")).scalar()->text.text(), "a");
  EXPECT_EQ(yaml11_value(LocatedText("")).scalar()->type, Scalar::Type::kNull);
  EXPECT_EQ(yaml11_value(LocatedText("# x")).scalar()->type, Scalar::Type::kNull);
  const Value list = yaml11_value(LocatedText("[1, a, [yes]]"));
  ASSERT_NE(list.list(), nullptr);
  ASSERT_EQ(list.list()->size(), 3U);
  EXPECT_EQ((*list.list())[0].scalar()->int_value, 1);
  EXPECT_EQ((*list.list())[1].scalar()->text.text(), "a");
  EXPECT_TRUE((*(*list.list())[2].list())[0].scalar()->bool_value);
  EXPECT_EQ(yaml11_value(LocatedText("- 1")).list()->size(), 1U);
  EXPECT_TRUE(yaml11_value(LocatedText("[]")).list()->empty());
}

TEST(Yaml11Value, TakesPlainTextsAsTheyAre) {
  for (const char* const text :
       {"a", "two words", "x.y, z", "$(var x) s", "/a/b", "it's", "x=\"y\"", "_", "a#b", "c::d", "$(eval '1 + 2')"}) {
    const Value value = yaml11_value(LocatedText(text));
    EXPECT_EQ(value.scalar()->type, Scalar::Type::kString) << text;
    EXPECT_EQ(value.scalar()->text.text(), text);
  }
  EXPECT_EQ(yaml11_value(LocatedText("-1.5")).scalar()->float_value, -1.5);
  EXPECT_EQ(yaml11_value(LocatedText("+.5")).scalar()->type, Scalar::Type::kString);
  EXPECT_EQ(yaml11_value(LocatedText(" a ")).scalar()->text.text(), "a");
  EXPECT_EQ(yaml11_value(LocatedText("a\nb")).scalar()->text.text(), "a b");
  EXPECT_EQ(yaml11_value(LocatedText("\"a\"")).scalar()->text.text(), "a");
  EXPECT_EQ(yaml11_value(LocatedText("---")).scalar()->type, Scalar::Type::kNull);
}

TEST(Yaml11Value, RefusesMappingsAndInvalidYaml) {
  for (const char* text : {"{a: 1}", "a: b", "[{a: 1}]", "@x", "*x", "[1, 2", "'open"}) {
    EXPECT_THROW(yaml11_value(LocatedText(text)), LaunchError) << text;
  }
}

TEST(Yaml11Value, KeepsPlacesInTheFileThatTheTextCameFrom) {
  const Entity root = xml("<launch>\n<param value=\"&#91;1, &quot;a b&quot;]\"/></launch>");
  const Value value = yaml11_value(root.children[0].find("value")->value.scalar()->text);
  ASSERT_NE(value.list(), nullptr);
  EXPECT_EQ(raw((*value.list())[0].where), "1");
  EXPECT_EQ(raw((*value.list())[1].where), "a b");
}

}  // namespace
}  // namespace launch
