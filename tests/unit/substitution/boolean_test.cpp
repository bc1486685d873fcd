// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/boolean.hpp"

#include <gtest/gtest.h>

namespace launch {
namespace {

TEST(ConditionBoolean, IsTrueOneFalseZeroInAnyCaseAfterTrimming) {
  for (const char* text : {"true", "True", "tRuE", "1", " true\n"}) {
    EXPECT_EQ(condition_boolean(text), true) << text;
  }
  for (const char* text : {"false", "FALSE", "0", "\t0 "}) {
    EXPECT_EQ(condition_boolean(text), false) << text;
  }
  for (const char* text : {"", " ", "yes", "on", "off", "2", "typo", "true false"}) {
    EXPECT_EQ(condition_boolean(text), std::nullopt) << text;
  }
}

TEST(YamlBoolean, IsAWordOfYaml11InItsThreeSpellingsOrADigit) {
  for (const char* text : {"1", "true", "True", "TRUE", "yes", "Yes", "YES", "on", "On", "ON"}) {
    EXPECT_EQ(yaml_boolean(text), true) << text;
  }
  for (const char* text : {"0", "false", "False", "FALSE", "no", "No", "NO", "off", "Off", "OFF"}) {
    EXPECT_EQ(yaml_boolean(text), false) << text;
  }
  for (const char* text : {"", "tRuE", "y", "n", "2", "0.0", " true", "oN"}) {
    EXPECT_EQ(yaml_boolean(text), std::nullopt) << text;
  }
}

TEST(LaunchEqual, ComparesBooleansThenNumbersThenText) {
  EXPECT_TRUE(launch_equal("1", "TRUE"));
  EXPECT_FALSE(launch_equal("true", "0"));
  EXPECT_TRUE(launch_equal("1e3", "1000"));
  EXPECT_TRUE(launch_equal("1000.0000001", "1000"));
  EXPECT_FALSE(launch_equal("10", "10.1"));
  EXPECT_FALSE(launch_equal("a", "A"));
  EXPECT_TRUE(launch_equal("", ""));
  EXPECT_FALSE(launch_equal("true", "10"));
}

TEST(LaunchEqual, ReadsNumbersAsPythonDoes) {
  EXPECT_TRUE(launch_equal(" 7 ", "7.0"));
  EXPECT_TRUE(launch_equal("1_000", "1000"));
  EXPECT_TRUE(launch_equal("+5", "5"));
  EXPECT_TRUE(launch_equal("inf", "Infinity"));
  EXPECT_TRUE(launch_equal("1e999", "inf"));
  EXPECT_FALSE(launch_equal("inf", "-inf"));
  EXPECT_FALSE(launch_equal("nan", "nan"));
  EXPECT_FALSE(launch_equal("0x10", "16")) << "hexadecimal is text";
  EXPECT_FALSE(launch_equal("1__0", "10"));
  EXPECT_FALSE(launch_equal("+-5", "-5"));
  EXPECT_FALSE(launch_equal("nan(1)", "1"));
}

}  // namespace
}  // namespace launch
