// SPDX-License-Identifier: Apache-2.0
// YAML to values, and its mistakes.
#include "launcher/message_types/read_value.hpp"

#include <gtest/gtest.h>

#include "launcher/message_types/print_value.hpp"
#include "test_library.hpp"

namespace {

class ReadValue : public testing::Test {
 protected:
  launch::MessageText read(const std::string& type, const std::string& yaml) {
    return read_message(*library_.message(type), located(yaml));
  }
  std::string flow(const std::string& type, const std::string& yaml) {
    launch::PrintStyle style;
    style.flow = true;
    return to_yaml({launch::FieldKind::kMessage, library_.message(type)}, read(type, yaml).value, style);
  }
  std::string errors(const std::string& type, const std::string& yaml) {
    return errors_of([&] { read(type, yaml); });
  }

  TestLibrary prefix_;
  launch::InterfaceLibrary library_ = prefix_.make();
};

TEST_F(ReadValue, TakesTextsAsTheyAreWritten) {
  EXPECT_EQ(flow("std_msgs/msg/String", "data: hello"), "{data: hello}\n");
  EXPECT_EQ(flow("std_msgs/msg/String", "{data: 007}"), "{data: '007'}\n");
  EXPECT_EQ(flow("std_msgs/msg/String", "{data: yes}"), "{data: 'yes'}\n");
  EXPECT_EQ(flow("std_msgs/msg/Float64", "{data: 1e3}"), "{data: 1000.0}\n");
  EXPECT_EQ(flow("std_msgs/msg/Float64", "{data: .inf}"), "{data: .inf}\n");
  EXPECT_EQ(flow("std_msgs/msg/Bool", "{data: 1}"), "{data: true}\n");
}

TEST_F(ReadValue, PutsTheTimeOfSendingWhereItIsAskedFor) {
  launch::MessageText message = read("test_interfaces/msg/Nested", "{header: auto}");
  message.stamp(3'000'000'004);
  EXPECT_EQ(to_yaml({launch::FieldKind::kMessage, library_.message("std_msgs/msg/Header")}, message.value.list()[1]),
            "stamp:\n  sec: 3\n  nanosec: 4\nframe_id: ''\n");
  message = read("std_msgs/msg/Header", "{stamp: now, frame_id: now}");
  message.stamp(5'000'000'000);
  EXPECT_EQ(to_csv({launch::FieldKind::kMessage, library_.message("std_msgs/msg/Header")}, message.value), "5,0,now");
}

TEST_F(ReadValue, ShowsThePlaceOfEachMistake) {
  EXPECT_EQ(errors("std_msgs/msg/Header", "{stamp: {sec: 1.5, nanosec: -1}, frame: map}"),
            "values:1:15: error: int32 is expected, found float '1.5'\n"
            "    1 | {stamp: {sec: 1.5, nanosec: -1}, frame: map}\n"
            "      |               ^~~\n"
            "values:1:29: error: -1 does not fit uint32, which goes from 0 to 4294967295\n"
            "    1 | {stamp: {sec: 1.5, nanosec: -1}, frame: map}\n"
            "      |                             ^~\n"
            "values:1:34: error: std_msgs/msg/Header has no field 'frame'\n"
            "    1 | {stamp: {sec: 1.5, nanosec: -1}, frame: map}\n"
            "      |                                  ^~~~~\n"
            "      = help: its fields are stamp, frame_id\n");
  EXPECT_EQ(errors("std_msgs/msg/String", "{dat: hi}"),
            "values:1:2: error: std_msgs/msg/String has no field 'dat'\n"
            "    1 | {dat: hi}\n"
            "      |  ^~~\n"
            "      = help: did you mean 'data'?\n");
  EXPECT_EQ(errors("std_msgs/msg/String", "hello"),
            "values:1:1: error: a message std_msgs/msg/String is expected, found str 'hello'\n"
            "    1 | hello\n"
            "      | ^~~~~\n"
            "      = help: write its fields as a mapping: '{data: …}'\n");
  EXPECT_EQ(errors("test_interfaces/msg/Bounded", "{name: 123456, bytes: [1, 2, 3, 4, 5], tags: 3}"),
            "values:1:8: error: string<=5 has at most 5 characters, found 6\n"
            "    1 | {name: 123456, bytes: [1, 2, 3, 4, 5], tags: 3}\n"
            "      |        ^~~~~~\n"
            "values:1:23: error: uint8[<=4] has at most 4 elements, found 5\n"
            "    1 | {name: 123456, bytes: [1, 2, 3, 4, 5], tags: 3}\n"
            "      |                       ^\n"
            "values:1:46: error: a list is expected for test_interfaces/Tagged[<=2], found int '3'\n"
            "    1 | {name: 123456, bytes: [1, 2, 3, 4, 5], tags: 3}\n"
            "      |                                              ^\n");
  EXPECT_EQ(errors("test_interfaces/msg/Sequences", "{flags: [true]}"),
            "values:1:9: error: bool[3] has 3 elements, found 1\n"
            "    1 | {flags: [true]}\n"
            "      |         ^\n");
  EXPECT_EQ(errors("std_msgs/msg/UInt64", "{data: 18446744073709551616}"),
            "values:1:8: error: uint64 is expected, found date '18446744073709551616'\n"
            "    1 | {data: 18446744073709551616}\n"
            "      |        ^~~~~~~~~~~~~~~~~~~~\n");
  EXPECT_NE(errors("std_msgs/msg/String", "{data: [}"), "");
}

}  // namespace
