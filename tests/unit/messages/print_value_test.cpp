// SPDX-License-Identifier: Apache-2.0
// Values as text.
#include "launcher/message_types/print_value.hpp"

#include <gtest/gtest.h>

#include "launcher/message_types/yaml_text.hpp"
#include "test_library.hpp"

namespace {

class PrintValue : public testing::Test {
 protected:
  std::string yaml(const std::string& type, const std::string& values, const launch::PrintStyle& style = {}) {
    const auto message = library_.message(type);
    return to_yaml({launch::FieldKind::kMessage, message}, read_message(*message, located(values)).value, style);
  }
  std::string csv(const std::string& type, const std::string& values, const launch::PrintStyle& style = {}) {
    const auto message = library_.message(type);
    return to_csv({launch::FieldKind::kMessage, message}, read_message(*message, located(values)).value, style);
  }

  TestLibrary prefix_;
  launch::InterfaceLibrary library_ = prefix_.make();
};

TEST_F(PrintValue, PrintsMessagesAsRos2TopicEchoDoes) {
  EXPECT_EQ(yaml("std_msgs/msg/String", "{data: 'Hello World: 1'}"), "data: 'Hello World: 1'\n");
  EXPECT_EQ(yaml("std_msgs/msg/Header", "{stamp: {sec: 3, nanosec: 4}, frame_id: map}"),
            "stamp:\n  sec: 3\n  nanosec: 4\nframe_id: map\n");
  EXPECT_EQ(yaml("test_interfaces/msg/Sequences", "{points: [{x: 1}, {y: 0.1}], names: [a]}"),
            "first: 0\ndoubles: []\nflags:\n- false\n- false\n- false\nswitches: []\nnames:\n- a\nnumbers: []\n"
            "points:\n- x: 1.0\n  y: 0.0\n- x: 0.0\n  y: 0.1\ncorners:\n- x: 0.0\n  y: 0.0\n- x: 0.0\n  y: 0.0\n"
            "wides: []\nlast: 0\n");
  EXPECT_EQ(yaml("std_msgs/msg/Float32", "{data: 0.1}"), "data: 0.10000000149011612\n");
  EXPECT_EQ(yaml("std_msgs/msg/Empty", ""), "structure_needs_at_least_one_member: 0\n");
}

TEST_F(PrintValue, TruncatesAndLeavesOut) {
  launch::PrintStyle style;
  style.truncate = 2;
  EXPECT_EQ(yaml("test_interfaces/msg/Defaults", "{name: grüße}", style),
            "number: -7\nratio: 2.0\n'on': true\nname: gr...\nsingle: it...\nwide: gr...\nthree:\n- 1\n- 2\n- '...'\n"
            "several:\n- 0.5\n- -1.0\nwords:\n- on...\n- th...\nplain: 0\n");
  style = {};
  style.no_arrays = true;
  style.no_strings = true;
  style.flow = true;
  EXPECT_EQ(yaml("test_interfaces/msg/Bounded", "{name: abc}", style),
            "{name: '<string length: <3>>', bytes: '<sequence type: uint8[4], length: 0>', "
            "tags: '<sequence type: test_interfaces/msg/Tagged[2], length: 0>'}\n");
}

TEST_F(PrintValue, WritesCsvAndPython) {
  EXPECT_EQ(csv("std_msgs/msg/Header", "{stamp: {sec: 3}, frame_id: 'a b'}"), "3,0,a b");
  EXPECT_EQ(csv("std_msgs/msg/Bool", "{data: true}"), "True");
  const auto header = library_.message("std_msgs/msg/Header");
  EXPECT_EQ(to_python(*header, read_message(*header, located("{frame_id: \"it's\"}")).value),
            "std_msgs.msg.Header(stamp=builtin_interfaces.msg.Time(sec=0, nanosec=0), frame_id=\"it's\")");
}

TEST(YamlText, QuotesWhatYamlWouldReadAsSomethingElse) {
  for (const char* const plain : {"hello", "a b", "it's", "x:y", "a#b", "-a", "/map", "a, b"}) {
    EXPECT_EQ(launch::yaml_text(plain, false), plain);
  }
  for (const char* const quoted :
       {"",   "1",          "1.5",  "true", "no",  "null", "~",  "a: b", "a #b", " a", "- a", "[a",
        "@a", "2001-01-01", "0x1f", "=",    "---", "a:",   "*a", "&a",   "%a",   "`a", "!a"}) {
    EXPECT_EQ(launch::yaml_text(quoted, false), "'" + std::string(quoted) + "'");
  }
  EXPECT_EQ(launch::yaml_text("a, b", true), "'a, b'");
  EXPECT_EQ(launch::yaml_text("#it's", false), "'#it''s'");
  EXPECT_EQ(launch::yaml_text("a\nb\x01", false), "\"a\\nb\\x01\"");
}

TEST(PythonText, WritesNumbersAndBytesAsPythonDoes) {
  EXPECT_EQ(launch::python_float(1), "1.0");
  EXPECT_EQ(launch::python_float(1e-5), "1e-05");
  EXPECT_EQ(launch::python_float(0.0001), "0.0001");
  EXPECT_EQ(launch::python_float(1e16), "1e+16");
  EXPECT_EQ(launch::python_float(123456789012345.0), "123456789012345.0");
  EXPECT_EQ(launch::python_float(-0.0), "-0.0");
  const std::uint8_t bytes[] = {0, 1, 'A', '\'', '\n'};
  EXPECT_EQ(launch::python_bytes(bytes, sizeof bytes), "b\"\\x00\\x01A'\\n\"");
}

}  // namespace
