// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <locale>
#include <rclcpp/parameter.hpp>

using rclcpp::Parameter;
using rclcpp::ParameterValue;

namespace {

TEST(ParameterValue, KeepsEachTypeAndPrintsIt) {
  EXPECT_EQ(ParameterValue(true).get<bool>(), true);
  EXPECT_EQ(ParameterValue(3).get<int64_t>(), 3);
  EXPECT_EQ(ParameterValue(3).get<int>(), 3);
  EXPECT_EQ(ParameterValue(1.5f).get<double>(), 1.5);
  EXPECT_EQ(ParameterValue("text").get<std::string>(), "text");
  EXPECT_EQ(ParameterValue(std::vector<int>{1, 2}).get<std::vector<int64_t>>(), (std::vector<int64_t>{1, 2}));
  EXPECT_EQ(ParameterValue(std::vector<float>{0.5f}).get<std::vector<double>>(), (std::vector<double>{0.5}));

  EXPECT_EQ(to_string(ParameterValue()), "not set");
  EXPECT_EQ(to_string(ParameterValue(std::vector<bool>{true, false})), "[true, false]");
  EXPECT_EQ(to_string(ParameterValue(std::vector<uint8_t>{10, 255})), "[0xa, 0xff]");
  EXPECT_EQ(to_string(ParameterValue(std::vector<std::string>{"a", "b"})), "[a, b]");
  EXPECT_EQ(to_string(rclcpp::PARAMETER_DOUBLE_ARRAY), "double_array");
}

TEST(ParameterValue, PrintsNumbersInTheSameWayInEachLocale) {
  struct Commas : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale(), new Commas));
  EXPECT_EQ(to_string(ParameterValue(1.5)), "1.500000");
  EXPECT_EQ(to_string(ParameterValue(std::vector<double>{0.25, 1e-6})), "[0.25, 1e-06]");
  std::locale::global(before);
}

TEST(ParameterValue, RefusesAnotherType) {
  try {
    ParameterValue(1).get<double>();
    FAIL() << "no exception";
  } catch (const rclcpp::ParameterTypeException& error) {
    EXPECT_STREQ(error.what(), "expected [double] got [integer]");
  }
}

TEST(Parameter, IsNotReadAsAnotherParameterType) {
  const Parameter parameter("speed", 1);
  EXPECT_THROW((void)parameter.as_double(), rclcpp::ParameterTypeException);
  EXPECT_THROW((void)parameter.get_value<rclcpp::PARAMETER_DOUBLE>(), rclcpp::ParameterTypeException);
}

TEST(Parameter, RefusesAnotherTypeWithItsName) {
  try {
    (void)Parameter("speed", 1).get_value<double>();
    FAIL() << "no exception";
  } catch (const rclcpp::exceptions::InvalidParameterTypeException& error) {
    EXPECT_STREQ(error.what(), "parameter 'speed' has invalid type: expected [double] got [integer]");
  }
}

TEST(Parameter, IsGotWithoutKnowingItsType) {
  const Parameter parameter("speed", 1.5);
  EXPECT_EQ(&parameter.get_value<Parameter>(), &parameter);
  EXPECT_EQ(&parameter.get_value<rclcpp::ParameterValue>(), &parameter.get_parameter_value());
}

TEST(Parameter, ConvertsToAMessageAndBack) {
  const Parameter parameter("name", std::vector<std::string>{"x"});
  EXPECT_EQ(Parameter::from_parameter_msg(parameter.to_parameter_msg()), parameter);
  EXPECT_EQ(to_string(parameter), R"({"name": "name", "type": "string_array", "value": "[x]"})");
}

}  // namespace
