// SPDX-License-Identifier: Apache-2.0
// Conditions on fields, and the choice of a field.
#include <gtest/gtest.h>

#include "launcher/message_types/message_condition.hpp"
#include "launcher/message_types/message_part.hpp"
#include "test_library.hpp"

namespace {

class Condition : public testing::Test {
 protected:
  bool holds(const std::string& condition, const std::string& yaml) {
    const auto type = library_.message("test_interfaces/msg/Nested");
    return launch::MessageCondition(type, located(condition)).holds(read_message(*type, located(yaml)).value);
  }
  std::string errors(const std::string& condition) {
    const auto type = library_.message("test_interfaces/msg/Nested");
    return errors_of([&] { launch::MessageCondition(type, located(condition, "where")); });
  }

  TestLibrary prefix_;
  launch::InterfaceLibrary library_ = prefix_.make();
  const std::string message_ =
      "{header: {frame_id: map, stamp: {sec: 3}}, primitives: {bool_value: true, float64_value: 2.5, "
      "uint64_value: 18446744073709551615, int64_value: -1}, defaults: [{number: 1, several: [4, 5]}, {}]}";
};

TEST_F(Condition, ComparesNumbersTextsAndBools) {
  EXPECT_TRUE(holds("header.stamp.sec > 2", message_));
  EXPECT_FALSE(holds("header.stamp.sec > 3", message_));
  EXPECT_TRUE(holds("header.stamp.sec >= 3 and header.frame_id == 'map'", message_));
  EXPECT_TRUE(holds("m.header.frame_id != \"odom\"", message_));
  EXPECT_TRUE(holds("primitives.bool_value", message_));
  EXPECT_FALSE(holds("not primitives.bool_value", message_));
  EXPECT_TRUE(holds("primitives.bool_value == True", message_));
  EXPECT_TRUE(holds("1 < primitives.float64_value < 3e0", message_));
  EXPECT_FALSE(holds("1 < primitives.float64_value < 2.5", message_));
  EXPECT_TRUE(holds("primitives.uint64_value == 18446744073709551615", message_));
  EXPECT_FALSE(holds("primitives.uint64_value == primitives.int64_value", message_));
  EXPECT_TRUE(holds("primitives.int64_value == -1 or false", message_));
  EXPECT_TRUE(holds("not (header.stamp.sec == 1 or header.stamp.sec == 2)", message_));
}

TEST_F(Condition, TakesTheSpellingOfConditionsOnEvents) {
  EXPECT_TRUE(holds("header.stamp.sec == 3 && !(primitives.float64_value < 2) || false", message_));
  EXPECT_TRUE(holds("header.frame_id =~ '^m.p$' && header.stamp.sec == 0x3", message_));
  EXPECT_FALSE(holds("header.frame_id =~ '^ap'", message_));
  EXPECT_TRUE(holds("header . frame_id =~ 'ma' and .header..frame_id == 'm\\ap'", message_));
}

TEST_F(Condition, ChoosesElementsAndLengths) {
  EXPECT_TRUE(holds("defaults[0].number == 1 and defaults[1].number == -7", message_));
  EXPECT_TRUE(holds("len(defaults[0].several) == 2 and len(header.frame_id) == 3", message_));
  EXPECT_TRUE(holds("defaults[0].several[1] == 5", message_));
  EXPECT_FALSE(holds("defaults[0].several[2] == 0", message_)) << "there is no such element";
}

TEST_F(Condition, ShowsThePlaceOfAMistake) {
  EXPECT_EQ(errors("header.stamp.secs > 1"),
            "where:1:14: error: builtin_interfaces/msg/Time has no field 'secs'\n"
            "    1 | header.stamp.secs > 1\n"
            "      |              ^~~~\n"
            "      = help: did you mean 'sec'?\n");
  EXPECT_EQ(errors("header.frame_id > 1"),
            "where:1:19: error: a text can't be compared with a number\n"
            "    1 | header.frame_id > 1\n"
            "      |                   ^\n");
  EXPECT_EQ(errors("header.stamp"),
            "where:1:1: error: builtin_interfaces/Time can't be compared as a whole\n"
            "    1 | header.stamp\n"
            "      | ^~~~~~~~~~~~\n"
            "      = help: choose a field of it with a point\n");
  EXPECT_EQ(errors("header.stamp.sec = 1"),
            "where:1:18: error: '=' is no comparison\n"
            "    1 | header.stamp.sec = 1\n"
            "      |                  ^\n"
            "      = help: write '=='\n");
  EXPECT_EQ(errors("header.stamp.sec"),
            "where:1:1: error: a number is no condition\n"
            "    1 | header.stamp.sec\n"
            "      | ^~~~~~~~~~~~~~~~\n"
            "      = help: compare it, for instance with '> 0'\n");
  EXPECT_EQ(errors("defaults[2].number == 1"),
            "where:1:9: error: test_interfaces/Defaults[2] has no element 2\n"
            "    1 | defaults[2].number == 1\n"
            "      |         ^~~\n"
            "      = help: the last one is [1]\n");
  EXPECT_EQ(errors("header.stamp.sec =~ '3'"),
            "where:1:21: error: a number can't be compared with a text\n"
            "    1 | header.stamp.sec =~ '3'\n"
            "      |                     ^~~\n");
  for (const char* const mistake : {"", "and", "header.frame_id == 'a", "(true", "1 <", "true true", "1.2.3 == 1",
                                    "len(header.stamp.sec) == 1", "header.frame_id[0] == 1", "@"}) {
    EXPECT_NE(errors(mistake), "") << mistake;
  }
}

TEST_F(Condition, FindsPartsOfMessages) {
  const auto type = library_.message("test_interfaces/msg/Nested");
  const auto value = read_message(*type, located(message_)).value;
  const launch::MessagePart path(type, located("defaults[0].several"));
  EXPECT_EQ(to_string(path.type()), "float32[]");
  ASSERT_NE(path.find(value), nullptr);
  EXPECT_EQ(path.find(value)->list().size(), 2U);
  EXPECT_EQ(launch::MessagePart(type, located("")).find(value), &value);
}

}  // namespace
