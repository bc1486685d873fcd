// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "std_msgs/msg/empty.hpp"
#include "std_msgs/msg/float64.hpp"
#include "std_msgs/msg/header.hpp"
#include "test_interfaces/msg/nested.hpp"
#include "test_interfaces/msg/sequences.hpp"

namespace {

TEST(Yaml, PrintsAMemberPerLine) {
  std_msgs::msg::Header message;
  message.stamp.sec = 3;
  message.frame_id = "a \"b\"\n\x01";
  EXPECT_EQ(to_yaml(message), R"(stamp:
  sec: 3
  nanosec: 0
frame_id: "a \"b\"\n\x01"
)");
  EXPECT_EQ(to_yaml(message, true), R"({stamp: {sec: 3, nanosec: 0}, frame_id: "a \"b\"\n\x01"})");
  EXPECT_EQ(rosidl_generator_traits::to_yaml(message), to_yaml(message));
}

TEST(Yaml, PrintsSequences) {
  test_interfaces::msg::Sequences message;
  message.doubles = {1.0, 0.1};
  message.switches = {true};
  message.names = {"x"};
  message.points.resize(1);
  message.wides = {u"\u00e4"};
  EXPECT_EQ(to_yaml(message), R"(first: 0
doubles:
- 1.0
- 0.1
flags:
- false
- false
- false
switches:
- true
names:
- "x"
numbers: []
points:
- {x: 0.0, y: 0.0}
corners:
- {x: 0.0, y: 0.0}
- {x: 0.0, y: 0.0}
wides:
- "\u00e4"
last: 0
)");
}

TEST(Yaml, PrintsNumbersThatReadBackAsTheSame) {
  std_msgs::msg::Float64 message;
  const auto print = [&](double value) {
    message.data = value;
    return std_msgs::msg::to_yaml(message, true);
  };
  EXPECT_EQ(print(0.1 + 0.2), "{data: 0.30000000000000004}");
  EXPECT_EQ(print(1e300), "{data: 1e+300}");
  EXPECT_EQ(print(-0.0), "{data: -0.0}");
  EXPECT_EQ(print(std::numeric_limits<double>::infinity()), "{data: .inf}");
  EXPECT_EQ(print(-std::numeric_limits<double>::infinity()), "{data: -.inf}");
  EXPECT_EQ(print(std::numeric_limits<double>::quiet_NaN()), "{data: .nan}");
}

TEST(Yaml, PrintsAMessageWithoutMembers) {
  EXPECT_EQ(to_yaml(std_msgs::msg::Empty()), "{}\n");
  EXPECT_EQ(to_yaml(std_msgs::msg::Empty(), true), "{}");
  EXPECT_EQ(to_yaml(test_interfaces::msg::Nested()).substr(0, 13), "nothing:\n  {}");
}

}  // namespace
