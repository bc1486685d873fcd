// SPDX-License-Identifier: Apache-2.0
// Values to bytes and back. The generated code of the same interfaces is the reference.
#include "launcher/message_types/cdr/cdr_codec.hpp"

#include <gtest/gtest.h>

#include "fastcdr_versions/cdr.hpp"
#include "rosidl_typesupport_cpp/message_type_support.hpp"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"
#include "test_interfaces/msg/awkward.hpp"
#include "test_interfaces/msg/bounded.hpp"
#include "test_interfaces/msg/defaults.hpp"
#include "test_interfaces/msg/nested.hpp"
#include "test_interfaces/msg/nothing.hpp"
#include "test_interfaces/msg/primitives.hpp"
#include "test_interfaces/msg/sequences.hpp"
#include "test_library.hpp"

namespace {

using Bytes = std::vector<std::uint8_t>;

template <typename Message>
Bytes generated_bytes(const Message& message) {
  const auto* const handle = rosidl_typesupport_cpp::get_message_type_support_handle<Message>();
  const auto& callbacks = *static_cast<const message_type_support_callbacks_t*>(handle->data);
  Bytes bytes(4 + callbacks.get_serialized_size(&message));
  eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
  eprosima::fastcdr::Cdr cdr = fastcdr_versions::plain_cdr(buffer);
  cdr.serialize_encapsulation();
  EXPECT_TRUE(callbacks.cdr_serialize(&message, cdr));
  return bytes;
}

class CdrCodec : public testing::Test {
 protected:
  // The YAML gives the bytes of the message, and the bytes give the value again.
  template <typename Message>
  void expect_bytes(const std::string& type, const std::string& yaml, const Message& message) {
    const auto description = library_.message(type);
    const launch::MessageValue value = read_message(*description, located(yaml)).value;
    const Bytes bytes = to_cdr(*description, value);
    EXPECT_EQ(bytes, generated_bytes(message));
    EXPECT_EQ(from_cdr(*description, bytes.data(), bytes.size()), value);
  }

  TestLibrary prefix_;
  launch::InterfaceLibrary library_ = prefix_.make();
};

TEST_F(CdrCodec, WritesTheBytesOfGeneratedCodeForEachPrimitive) {
  test_interfaces::msg::Primitives message;
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
  message.uint64_value = 0xf23456789abcdef0;
  message.string_value = "hi";
  message.wstring_value = u"äb😀";
  expect_bytes("test_interfaces/msg/Primitives",
               "{bool_value: true, byte_value: 0xfe, char_value: 65, float32_value: 1.5, int8_value: -2, "
               "float64_value: -0.5, uint8_value: 200, int16_value: -3, uint16_value: 0x1234, int32_value: -4, "
               "uint32_value: 305419896, int64_value: -5, uint64_value: 17452669531959647984, string_value: hi, "
               "wstring_value: äb😀}",
               message);
}

TEST_F(CdrCodec, WritesTheBytesOfGeneratedCodeForArraysAndSequences) {
  test_interfaces::msg::Sequences message;
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
  expect_bytes("test_interfaces/msg/Sequences",
               "{first: 1, doubles: [1.0], flags: [true, false, true], switches: [false, true], names: [a, ''], "
               "numbers: [-1, 2], points: [{x: 1, y: 2}], corners: [{}, {y: 1}], wides: [z], last: 9}",
               message);
  expect_bytes("test_interfaces/msg/Sequences", "{}", test_interfaces::msg::Sequences());
}

TEST_F(CdrCodec, KnowsDefaultsBoundsNestedAndEmptyMessages) {
  expect_bytes("test_interfaces/msg/Defaults", "", test_interfaces::msg::Defaults());
  expect_bytes("test_interfaces/msg/Awkward", "{}", test_interfaces::msg::Awkward());
  expect_bytes("test_interfaces/msg/Nothing", "{}", test_interfaces::msg::Nothing());
  test_interfaces::msg::Nested nested;
  nested.header.frame_id = "map";
  nested.header.stamp.sec = 3;
  nested.primitives.uint8_value = 7;
  nested.defaults[1].number = 4;
  expect_bytes("test_interfaces/msg/Nested",
               "header: {frame_id: map, stamp: {sec: 3}}\nprimitives: {uint8_value: 7}\ndefaults: [{}, {number: 4}]",
               nested);
  test_interfaces::msg::Bounded bounded;
  bounded.name = "12345";
  bounded.bytes = {1, 2, 3, 4};
  bounded.tags.resize(2);
  bounded.tags[1].tag = 5;
  expect_bytes("test_interfaces/msg/Bounded", "{name: 12345, bytes: [1, 2, 3, 4], tags: [{}, {tag: 5}]}", bounded);
}

TEST_F(CdrCodec, ReadsTheOtherByteOrder) {
  const auto type = library_.message("std_msgs/msg/Int32");
  const Bytes big_endian = {0, 0, 0, 0, 0, 0, 1, 2};
  const launch::MessageValue value = from_cdr(*type, big_endian.data(), big_endian.size());
  EXPECT_EQ(std::get<std::int64_t>(value.list().front().data), 258);
}

TEST_F(CdrCodec, RefusesBytesThatAreCutShortOrLieAboutALength) {
  const auto type = library_.message("test_interfaces/msg/Sequences");
  const Bytes bytes = to_cdr(*type, read_message(*type, located("{names: [one, two], doubles: [1, 2]}")).value);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW((void)from_cdr(*type, bytes.data(), size), std::runtime_error) << size;
  }
  const auto text = library_.message("std_msgs/msg/String");
  const Bytes lying = {0, 1, 0, 0, 0xff, 0xff, 0xff, 0x7f, 'a'};
  EXPECT_THROW((void)from_cdr(*text, lying.data(), lying.size()), std::runtime_error);
}

}  // namespace
