// SPDX-License-Identifier: Apache-2.0
// The wire format of ROS 2, byte by byte. The expected bytes were written by hand from the CDR rules.
#include "fastcdr_versions/cdr.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "cdr_bytes.hpp"
#include "rcl_interfaces/msg/log.hpp"
#include "rcl_interfaces/msg/parameter_event.hpp"
#include "rmw_dds_common/msg/participant_entities_info.hpp"
#include "sensor_msgs/msg/imu.hpp"
#include "std_msgs/msg/empty.hpp"
#include "std_msgs/msg/header.hpp"
#include "std_msgs/msg/int32.hpp"
#include "std_msgs/msg/string.hpp"
#include "test_interfaces/msg/bounded.hpp"
#include "test_interfaces/msg/nested.hpp"
#include "test_interfaces/msg/primitives.hpp"
#include "test_interfaces/msg/sequences.hpp"
#include "test_interfaces/msg/tagged.hpp"

namespace {

using test_interfaces::msg::Bounded;
using test_interfaces::msg::Nested;
using test_interfaces::msg::Primitives;
using test_interfaces::msg::Sequences;

// The message has exactly these bytes, and they read back as the message.
template <typename Message>
void expect_bytes(const Message& message, std::string_view bytes) {
  const std::vector<char> expected = bytes_of(bytes);
  EXPECT_EQ(serialized(message), text_of(expected.data(), expected.size()));
  Message read(rosidl_runtime_cpp::MessageInitialization::ZERO);
  EXPECT_TRUE(deserialize(expected, read));
  EXPECT_EQ(read, message);
}

Primitives some_primitives() {
  Primitives message;
  message.bool_value = true;
  message.byte_value = 0xfe;
  message.char_value = 'A';
  message.float32_value = 1.5f;
  message.int8_value = -2;
  message.float64_value = -0.5;
  message.uint8_value = 200;
  message.int16_value = -3;
  message.uint16_value = 0x1234;
  message.int32_value = -4;
  message.uint32_value = 0x12345678;
  message.int64_value = -5;
  message.uint64_value = 0x123456789abcdef0;
  message.string_value = "hi";
  message.wstring_value = u"\u00e4b";
  return message;
}

Sequences some_sequences() {
  Sequences message;
  message.first = 1;
  message.doubles = {1.0};
  message.flags = {true, false, true};
  message.switches = {false, true};
  message.names = {"a", ""};
  message.numbers = {-1, 2};
  message.points.resize(1);
  message.points[0].x = 1.0f;
  message.points[0].y = 2.0;
  message.corners[1].y = 1.0;
  message.wides = {u"z"};
  message.last = 9;
  return message;
}

TEST(Cdr, StringCarriesItsLengthWithTheFinalNul) {
  std_msgs::msg::String message;
  message.data = "hello";
  expect_bytes(message, "06 00 00 00  68 65 6c 6c 6f 00");
  expect_bytes(std_msgs::msg::String(), "01 00 00 00  00");
}

TEST(Cdr, StringKeepsAnEmbeddedNul) {
  std_msgs::msg::String message;
  message.data = std::string("a\0b", 3);
  expect_bytes(message, "04 00 00 00  61 00 62 00");
}

TEST(Cdr, StringWithoutFinalNulIsRead) {
  std_msgs::msg::String message;
  ASSERT_TRUE(deserialize(bytes_of("02 00 00 00  68 69"), message));
  EXPECT_EQ(message.data, "hi");
  ASSERT_TRUE(deserialize(bytes_of("00 00 00 00"), message));
  EXPECT_EQ(message.data, "");
}

TEST(Cdr, HeaderNestsTheTime) {
  std_msgs::msg::Header message;
  message.stamp.sec = -1;
  message.stamp.nanosec = 5;
  message.frame_id = "map";
  expect_bytes(message, "ff ff ff ff  05 00 00 00  04 00 00 00  6d 61 70 00");
}

TEST(Cdr, EmptyMessageIsOneByte) {
  expect_bytes(std_msgs::msg::Empty(), "00");
}

TEST(Cdr, PrimitivesAreAlignedToTheirSize) {
  expect_bytes(some_primitives(),
               "01 fe 41 00  00 00 c0 3f  fe 00 00 00 00 00 00 00  00 00 00 00 00 00 e0 bf  c8 00 fd ff  34 12 00 00"
               "fc ff ff ff  78 56 34 12  fb ff ff ff ff ff ff ff  f0 de bc 9a 78 56 34 12"
               "03 00 00 00  68 69 00 00  02 00 00 00  e4 00 00 00  62 00 00 00");
}

TEST(Cdr, SequencesCarryTheirLengthAndArraysDoNot) {
  expect_bytes(some_sequences(),
               "01 00 00 00  01 00 00 00  00 00 00 00 00 00 f0 3f"                // first, doubles
               "01 00 01 00  02 00 00 00  00 01 00 00"                            // flags, switches
               "02 00 00 00  02 00 00 00  61 00 00 00  01 00 00 00  00 00 00 00"  // names
               "02 00 00 00  ff ff 02 00"                                         // numbers
               "01 00 00 00  00 00 80 3f  00 00 00 00 00 00 00 40"                // points
               "00 00 00 00  00 00 00 00  00 00 00 00 00 00 00 00"                // corners[0]
               "00 00 00 00  00 00 00 00  00 00 00 00 00 00 f0 3f"                // corners[1]
               "01 00 00 00  01 00 00 00  7a 00 00 00  09");                      // wides, last
}

TEST(Cdr, EmptySequenceIsFollowedByNoPadding) {
  Sequences message;
  message.flags[0] = true;
  message.corners[0].x = 1.0f;
  message.last = 9;
  // `flags` follows the length of `doubles` without the padding that a double would need; so does corners[0].x.
  expect_bytes(message,
               "00 00 00 00  00 00 00 00"                           // first, doubles
               "01 00 00 00  00 00 00 00"                           // flags, switches
               "00 00 00 00  00 00 00 00  00 00 00 00"              // names, numbers, points
               "00 00 80 3f  00 00 00 00 00 00 00 00"               // corners[0]
               "00 00 00 00  00 00 00 00  00 00 00 00 00 00 00 00"  // corners[1]
               "00 00 00 00  09");                                  // wides, last
}

TEST(Cdr, DiscoveryMessageIsThatOfRmwDdsCommon) {
  rmw_dds_common::msg::ParticipantEntitiesInfo message;
  message.gid.data[0] = 1;
  message.gid.data[15] = 0xc1;
  message.node_entities_info_seq.resize(1);
  auto& node = message.node_entities_info_seq[0];
  node.node_namespace = "/";
  node.node_name = "ping";
  node.writer_gid_seq.resize(1);
  node.writer_gid_seq[0].data[15] = 3;
  expect_bytes(message,
               "01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 c1"
               "01 00 00 00  02 00 00 00  2f 00 00 00  05 00 00 00  70 69 6e 67 00 00 00 00  00 00 00 00"
               "01 00 00 00  00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 03");
}

TEST(Cdr, LogMessagePadsBetweenByteAndString) {
  rcl_interfaces::msg::Log message;
  message.level = rcl_interfaces::msg::Log::INFO;
  message.name = "n";
  message.line = 7;
  expect_bytes(message,
               "00 00 00 00  00 00 00 00  14 00 00 00  02 00 00 00  6e 00 00 00  01 00 00 00  00 00 00 00"
               "01 00 00 00  00 00 00 00  01 00 00 00  00 00 00 00  07 00 00 00");
}

TEST(Cdr, BigEndianBytesAreRead) {
  std::vector<char> bytes = bytes_of("12 34 56 78");
  eprosima::fastcdr::FastBuffer buffer(bytes.data(), bytes.size());
  eprosima::fastcdr::Cdr cdr = fastcdr_versions::plain_cdr(buffer, eprosima::fastcdr::Cdr::BIG_ENDIANNESS);
  std_msgs::msg::Int32 message;
  ASSERT_TRUE(callbacks<std_msgs::msg::Int32>().cdr_deserialize(cdr, &message));
  EXPECT_EQ(message.data, 0x12345678);
}

TEST(Cdr, EveryTruncationIsRefused) {
  for (const std::string& whole : {serialized(some_sequences()), serialized(some_primitives())}) {
    const std::vector<char> bytes = bytes_of(whole);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const std::vector<char> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
      bool accepted = false;
      if (whole == serialized(some_sequences())) {
        Sequences message;
        accepted = deserialize(cut, message);
      } else {
        Primitives message;
        accepted = deserialize(cut, message);
      }
      EXPECT_FALSE(accepted) << "cut to " << length << " bytes";
    }
  }
}

TEST(Cdr, TooSmallABufferIsRefused) {
  const Sequences message = some_sequences();
  const std::size_t size = callbacks<Sequences>().get_serialized_size(&message);
  for (std::size_t capacity = 0; capacity < size; ++capacity) {
    EXPECT_EQ(serialized(message, capacity), std::nullopt) << capacity;
  }
  EXPECT_NE(serialized(message, size), std::nullopt);
}

TEST(Cdr, LengthBeyondTheMessageIsRefusedBeforeMemoryIsTaken) {
  std_msgs::msg::String string;
  EXPECT_FALSE(deserialize(bytes_of("ff ff ff ff  61 00"), string));
  EXPECT_LT(string.data.capacity(), 1000u);
  Sequences sequences;
  EXPECT_FALSE(deserialize(bytes_of("00 00 00 00  ff ff ff 7f  00 00 00 00"), sequences));
  EXPECT_LT(sequences.doubles.capacity(), 1000u);
}

TEST(Cdr, MoreMessagesThanTheBytesHaveRoomForTakeNoMemory) {
  // A node has at least the lengths of two strings and two sequences: 16 bytes.
  rmw_dds_common::msg::ParticipantEntitiesInfo info;
  std::vector<char> bytes(16 + 4 + 16 * 1000);
  bytes[16] = static_cast<char>(1001 & 255);
  bytes[17] = static_cast<char>(1001 >> 8);
  EXPECT_FALSE(deserialize(bytes, info));
  EXPECT_EQ(info.node_entities_info_seq.capacity(), 0u);
  bytes[16] = static_cast<char>(1000 & 255);
  EXPECT_TRUE(deserialize(bytes, info));
  EXPECT_EQ(info.node_entities_info_seq.size(), 1000u);
}

TEST(Cdr, MoreElementsThanTheBoundAreRefused) {
  Bounded message;
  EXPECT_TRUE(deserialize(bytes_of("01 00 00 00 00 00 00 00  04 00 00 00 01 02 03 04  00 00 00 00"), message));
  EXPECT_EQ(message.bytes.size(), 4u);
  EXPECT_FALSE(
      deserialize(bytes_of("01 00 00 00 00 00 00 00  05 00 00 00 01 02 03 04 05 00 00 00  00 00 00 00"), message));
}

TEST(Cdr, BoolOtherThanZeroAndOneIsRefused) {
  Primitives message = some_primitives();
  std::vector<char> bytes = bytes_of(serialized(message));
  bytes[0] = 2;
  EXPECT_FALSE(deserialize(bytes, message));
}

TEST(CdrSize, NestedMessagesAreAlignedFromTheBeginningOfThePayload) {
  Nested message;
  message.header.frame_id = "abc";
  message.primitives = some_primitives();
  const std::string bytes = serialized(message);
  Nested read;
  ASSERT_TRUE(deserialize(bytes_of(bytes), read));
  EXPECT_EQ(read, message);
  EXPECT_EQ(bytes_of(bytes).size(), callbacks<Nested>().get_serialized_size(&message));
}

template <typename Message>
std::pair<std::size_t, int> max_size() {
  char bounds = 0x7f;
  const std::size_t size = callbacks<Message>().max_serialized_size(bounds);
  return {size, bounds};
}

TEST(CdrSize, PlainTypesHaveTheLayoutOfTheirBytes) {
  EXPECT_EQ(max_size<std_msgs::msg::Int32>(), (std::pair<std::size_t, int>(4, ROSIDL_TYPESUPPORT_FASTRTPS_PLAIN_TYPE)));
  EXPECT_EQ(max_size<test_interfaces::msg::Point>(),
            (std::pair<std::size_t, int>(16, ROSIDL_TYPESUPPORT_FASTRTPS_PLAIN_TYPE)));
  EXPECT_EQ(max_size<test_interfaces::msg::Tagged>(),
            (std::pair<std::size_t, int>(17, ROSIDL_TYPESUPPORT_FASTRTPS_PLAIN_TYPE)));
}

TEST(CdrSize, BoundedTypesHaveAnUpperBoundThatTheLargestMessageReaches) {
  Bounded message;
  message.name = "12345";
  message.bytes = {1, 2, 3, 4};
  message.tags.resize(2);
  const std::size_t size = callbacks<Bounded>().get_serialized_size(&message);
  EXPECT_EQ(max_size<Bounded>(), (std::pair<std::size_t, int>(size, ROSIDL_TYPESUPPORT_FASTRTPS_BOUNDED_TYPE)));
}

TEST(CdrSize, UnboundedTypesCountAsEmpty) {
  EXPECT_EQ(max_size<std_msgs::msg::String>(),
            (std::pair<std::size_t, int>(5, ROSIDL_TYPESUPPORT_FASTRTPS_UNBOUNDED_TYPE)));
  EXPECT_EQ(max_size<rcl_interfaces::msg::ParameterEvent>().second, ROSIDL_TYPESUPPORT_FASTRTPS_UNBOUNDED_TYPE);
  EXPECT_EQ(max_size<sensor_msgs::msg::Imu>().second, ROSIDL_TYPESUPPORT_FASTRTPS_UNBOUNDED_TYPE);
}

}  // namespace
