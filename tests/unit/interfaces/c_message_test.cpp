// SPDX-License-Identifier: Apache-2.0
// C messages: their structures, functions and bytes, which are those of the C++ messages.
#include <gtest/gtest.h>

#include "cdr_bytes.hpp"
#include "fastcdr_versions/cdr.hpp"
#include "rosidl_runtime_c/primitives_sequence_functions.h"
#include "rosidl_runtime_c/string_functions.h"
#include "rosidl_runtime_c/u16string_functions.h"
#include "rosidl_typesupport_fastrtps_cpp/find_callbacks.hpp"
#include "service_msgs/msg/service_event_info.h"
#include "test_interfaces/msg/awkward.h"
#include "test_interfaces/msg/bounded.h"
#include "test_interfaces/msg/defaults.h"
#include "test_interfaces/msg/nested.h"
#include "test_interfaces/msg/nested.hpp"
#include "test_interfaces/msg/nothing.h"
#include "test_interfaces/msg/primitives.h"
#include "test_interfaces/msg/sequences.h"
#include "test_interfaces/msg/sequences.hpp"
#include "test_interfaces/srv/add_two_ints.h"

namespace {

const message_type_support_callbacks_t& callbacks_of(const rosidl_message_type_support_t* handle) {
  return *rosidl_typesupport_fastrtps_cpp::find_callbacks(handle);
}

std::string bytes_of_c(const rosidl_message_type_support_t* handle, const void* message) {
  const auto& callbacks = callbacks_of(handle);
  std::vector<char> bytes(callbacks.get_serialized_size(message));
  eprosima::fastcdr::FastBuffer buffer(bytes.data(), bytes.size());
  eprosima::fastcdr::Cdr cdr = fastcdr_versions::plain_cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS);
  if (!callbacks.cdr_serialize(message, cdr)) {
    return "does not fit";
  }
  return text_of(bytes.data(), fastcdr_versions::written_size(cdr));
}

bool read_c(const rosidl_message_type_support_t* handle, const std::string& text, void* message) {
  std::vector<char> bytes = bytes_of(text);
  eprosima::fastcdr::FastBuffer buffer(bytes.data(), bytes.size());
  eprosima::fastcdr::Cdr cdr = fastcdr_versions::plain_cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS);
  return callbacks_of(handle).cdr_deserialize(cdr, message);
}

// A C message that ends with its scope.
template <typename Message, auto Init, auto Fini>
struct Scoped : Message {
  Scoped() { EXPECT_TRUE(Init(this)); }
  ~Scoped() { Fini(this); }
  Scoped(const Scoped&) = delete;
  Scoped& operator=(const Scoped&) = delete;
};

#define SCOPED(MESSAGE) Scoped<MESSAGE, MESSAGE##__init, MESSAGE##__fini>

using SequencesInC = SCOPED(test_interfaces__msg__Sequences);
using NestedInC = SCOPED(test_interfaces__msg__Nested);

test_interfaces::msg::Sequences sequences_of_all_kinds() {
  test_interfaces::msg::Sequences message;
  message.first = 1;
  message.doubles = {1.0, -2.5};
  message.flags = {true, false, true};
  message.switches = {false, true};
  message.names = {"a", ""};
  message.numbers = {-1, 2};
  message.points.resize(2);
  message.points[1].y = 2.0;
  message.corners[1].y = 1.0;
  message.wides = {u"z\u00e4"};
  message.last = 9;
  return message;
}

TEST(CMessage, HasTheDefaultsAndConstantsOfItsFile) {
  SCOPED(test_interfaces__msg__Defaults) message;
  EXPECT_EQ(message.number, -7);
  EXPECT_EQ(message.ratio, 2.0);
  EXPECT_TRUE(message.on);
  EXPECT_STREQ(message.name.data, "a\tb");
  EXPECT_EQ(message.wide.size, 4u);
  EXPECT_EQ(message.wide.data[2], 0xfc);
  EXPECT_EQ(message.three[2], 3);
  ASSERT_EQ(message.several.size, 2u);
  EXPECT_EQ(message.several.data[1], -1.0f);
  ASSERT_EQ(message.words.size, 2u);
  EXPECT_STREQ(message.words.data[0].data, "one, two");
  EXPECT_EQ(message.plain, 0);
  SCOPED(test_interfaces__msg__Awkward) awkward;
  EXPECT_STREQ(awkward.words[1].data, "b");

  EXPECT_EQ(test_interfaces__msg__Defaults__ANSWER, 42);
  EXPECT_EQ(test_interfaces__msg__Defaults__HALF, 0.5f);
  EXPECT_STREQ(test_interfaces__msg__Defaults__GREETING, "hello, # \"you\"");
  EXPECT_EQ(test_interfaces__msg__Defaults__SMALLEST, INT64_MIN);
  EXPECT_TRUE(test_interfaces__msg__Defaults__YES);
  EXPECT_EQ(test_interfaces__msg__Bounded__bytes__MAX_SIZE, 4);
  EXPECT_EQ(test_interfaces__msg__Bounded__name__MAX_STRING_SIZE, 5);
}

TEST(CMessage, HasTheBytesOfTheCppMessage) {
  const auto* handle = ROSIDL_GET_MSG_TYPE_SUPPORT(test_interfaces, msg, Sequences);
  const std::string bytes = serialized(sequences_of_all_kinds());
  SequencesInC message;
  ASSERT_TRUE(read_c(handle, bytes, &message));
  EXPECT_EQ(message.doubles.data[1], -2.5);
  EXPECT_TRUE(message.switches.data[1]);
  EXPECT_STREQ(message.names.data[0].data, "a");
  EXPECT_EQ(message.points.data[1].y, 2.0);
  EXPECT_EQ(message.wides.data[0].data[1], 0xe4);
  EXPECT_EQ(message.last, 9);
  EXPECT_EQ(bytes_of_c(handle, &message), bytes);
  // A message that is used again keeps its memory.
  ASSERT_TRUE(read_c(handle, serialized(test_interfaces::msg::Sequences()), &message));
  EXPECT_EQ(message.doubles.size, 0u);
  ASSERT_TRUE(read_c(handle, bytes, &message));
  EXPECT_EQ(bytes_of_c(handle, &message), bytes);
  const NestedInC nested;
  EXPECT_EQ(bytes_of_c(ROSIDL_GET_MSG_TYPE_SUPPORT(test_interfaces, msg, Nested), &nested),
            serialized(test_interfaces::msg::Nested()));
}

TEST(CMessage, IsCopiedAndCompared) {
  const auto* handle = ROSIDL_GET_MSG_TYPE_SUPPORT(test_interfaces, msg, Sequences);
  SequencesInC message;
  SequencesInC other;
  ASSERT_TRUE(read_c(handle, serialized(sequences_of_all_kinds()), &message));
  EXPECT_FALSE(test_interfaces__msg__Sequences__are_equal(&message, &other));
  EXPECT_TRUE(test_interfaces__msg__Sequences__copy(&message, &other));
  EXPECT_TRUE(test_interfaces__msg__Sequences__are_equal(&message, &other));
  EXPECT_NE(message.names.data, other.names.data);
  rosidl_runtime_c__String__assign(&other.names.data[1], "b");
  EXPECT_FALSE(test_interfaces__msg__Sequences__are_equal(&message, &other));
  EXPECT_FALSE(test_interfaces__msg__Sequences__copy(&message, nullptr));
  EXPECT_FALSE(test_interfaces__msg__Sequences__are_equal(nullptr, &message));
  EXPECT_FALSE(test_interfaces__msg__Sequences__init(nullptr));
}

TEST(CMessage, SequencesOfMessagesAreMadeAndCopied) {
  auto* some = test_interfaces__msg__Defaults__Sequence__create(2);
  test_interfaces__msg__Defaults__Sequence more;
  ASSERT_TRUE(test_interfaces__msg__Defaults__Sequence__init(&more, 0));
  EXPECT_EQ(some->data[1].number, -7);
  EXPECT_FALSE(test_interfaces__msg__Defaults__Sequence__are_equal(some, &more));
  EXPECT_TRUE(test_interfaces__msg__Defaults__Sequence__copy(some, &more));
  EXPECT_TRUE(test_interfaces__msg__Defaults__Sequence__are_equal(some, &more));
  test_interfaces__msg__Defaults__Sequence__fini(&more);
  test_interfaces__msg__Defaults__Sequence__fini(&more);
  EXPECT_EQ(more.data, nullptr);
  test_interfaces__msg__Defaults__Sequence__destroy(some);
}

TEST(CMessage, RefusesBytesThatAreNoMessage) {
  const auto* handle = ROSIDL_GET_MSG_TYPE_SUPPORT(test_interfaces, msg, Bounded);
  SCOPED(test_interfaces__msg__Bounded) message;
  EXPECT_TRUE(read_c(handle, "01 00 00 00 00  00 00 00  00 00 00 00  00 00 00 00", &message));
  EXPECT_FALSE(read_c(handle, "01 00 00 00 00  00 00 00  05 00 00 00  01 02 03 04 05 00 00 00 00 00 00 00", &message));
  EXPECT_FALSE(read_c(handle, "ff ff ff ff 00", &message));
  EXPECT_FALSE(read_c(handle, "", &message));
  // More elements than the bytes have room for need no memory.
  const auto* sequences = ROSIDL_GET_MSG_TYPE_SUPPORT(test_interfaces, msg, Sequences);
  SequencesInC many;
  EXPECT_FALSE(read_c(sequences, "01 00 00 00  ff ff ff 0f  00 00 00 00", &many));
  EXPECT_EQ(many.doubles.capacity, 0u);
}

TEST(CMessage, RefusesToWriteWhatTheTypeDoesNotAllow) {
  const auto* handle = ROSIDL_GET_MSG_TYPE_SUPPORT(test_interfaces, msg, Bounded);
  SCOPED(test_interfaces__msg__Bounded) message;
  ASSERT_TRUE(rosidl_runtime_c__uint8__Sequence__init(&message.bytes, 5));
  EXPECT_EQ(bytes_of_c(handle, &message), "does not fit");
}

TEST(CMessage, TellsTheSizesOfItsType) {
  char bounds = 0;
  char bounds_of_cpp = 0;
  const auto& primitives = callbacks_of(ROSIDL_GET_MSG_TYPE_SUPPORT(test_interfaces, msg, Sequences));
  EXPECT_EQ(primitives.max_serialized_size(bounds),
            callbacks<test_interfaces::msg::Sequences>().max_serialized_size(bounds_of_cpp));
  EXPECT_EQ(bounds, bounds_of_cpp);
  EXPECT_EQ(primitives.message_namespace_, std::string("test_interfaces::msg"));
  EXPECT_EQ(primitives.type_hash_, std::string(callbacks<test_interfaces::msg::Sequences>().type_hash_));
  const auto& nothing = callbacks_of(ROSIDL_GET_MSG_TYPE_SUPPORT(test_interfaces, msg, Nothing));
  EXPECT_EQ(nothing.max_serialized_size(bounds), 1u);
  EXPECT_EQ(bounds, ROSIDL_TYPESUPPORT_FASTRTPS_PLAIN_TYPE);
}

TEST(CMessage, EventsOfServicesHaveCopiesOfTheirMessages) {
  const auto* handle = ROSIDL_GET_SRV_TYPE_SUPPORT(test_interfaces, srv, AddTwoInts);
  EXPECT_EQ(handle->request_typesupport, ROSIDL_GET_MSG_TYPE_SUPPORT(test_interfaces, srv, AddTwoInts_Request));
  EXPECT_STREQ(rosidl_typesupport_fastrtps_cpp::find_callbacks(handle)->service_name_, "AddTwoInts");
  rosidl_service_introspection_info_t info{};
  info.event_type = service_msgs__msg__ServiceEventInfo__REQUEST_RECEIVED;
  info.stamp_sec = 3;
  info.stamp_nanosec = 4;
  info.client_gid[15] = 5;
  info.sequence_number = 6;
  SCOPED(test_interfaces__srv__AddTwoInts_Request) request;
  request.b = 7;
  auto* event = static_cast<test_interfaces__srv__AddTwoInts_Event*>(
      handle->event_message_create_handle_function(&info, &request, nullptr));
  EXPECT_EQ(event->info.event_type, 1);
  EXPECT_EQ(event->info.stamp.sec, 3);
  EXPECT_EQ(event->info.stamp.nanosec, 4u);
  EXPECT_EQ(event->info.client_gid[15], 5);
  EXPECT_EQ(event->info.sequence_number, 6);
  ASSERT_EQ(event->request.size, 1u);
  EXPECT_EQ(event->request.data[0].b, 7);
  EXPECT_EQ(event->response.size, 0u);
  handle->event_message_destroy_handle_function(event);
}

TEST(CString, IsAssignedResizedAndCompared) {
  rosidl_runtime_c__String text;
  ASSERT_TRUE(rosidl_runtime_c__String__init(&text));
  EXPECT_STREQ(text.data, "");
  EXPECT_EQ(text.capacity, 1u);
  EXPECT_TRUE(rosidl_runtime_c__String__assign(&text, "hello"));
  EXPECT_TRUE(rosidl_runtime_c__String__assignn(&text, text.data, 4));
  EXPECT_STREQ(text.data, "hell");
  EXPECT_FALSE(rosidl_runtime_c__String__assign(&text, nullptr));
  EXPECT_FALSE(rosidl_runtime_c__String__assignn(&text, "a", SIZE_MAX));
  rosidl_runtime_c__String other;
  ASSERT_TRUE(rosidl_runtime_c__String__init(&other));
  EXPECT_FALSE(rosidl_runtime_c__String__are_equal(&text, &other));
  EXPECT_TRUE(rosidl_runtime_c__String__copy(&text, &other));
  EXPECT_TRUE(rosidl_runtime_c__String__are_equal(&text, &other));
  EXPECT_TRUE(rosidl_runtime_c__String__resize(&other, 2));
  EXPECT_STREQ(other.data, "he");
  rosidl_runtime_c__String__fini(&text);
  rosidl_runtime_c__String__fini(&other);
  rosidl_runtime_c__String__fini(&other);
}

TEST(CString, OfWideCharactersIsMadeOfAsciiToo) {
  rosidl_runtime_c__U16String text;
  ASSERT_TRUE(rosidl_runtime_c__U16String__init(&text));
  EXPECT_TRUE(rosidl_runtime_c__U16String__assignn_from_char(&text, "abc", 2));
  EXPECT_EQ(text.size, 2u);
  EXPECT_EQ(rosidl_runtime_c__U16String__len(text.data), 2u);
  rosidl_runtime_c__U16String__fini(&text);
}

TEST(CSequence, OfNumbersIsComparedByValue) {
  rosidl_runtime_c__float64__Sequence one;
  rosidl_runtime_c__double__Sequence other;
  ASSERT_TRUE(rosidl_runtime_c__float64__Sequence__init(&one, 1));
  ASSERT_TRUE(rosidl_runtime_c__double__Sequence__init(&other, 1));
  one.data[0] = -0.0;
  EXPECT_TRUE(rosidl_runtime_c__double__Sequence__are_equal(&one, &other));
  one.data[0] = 1.0;
  EXPECT_FALSE(rosidl_runtime_c__double__Sequence__are_equal(&one, &other));
  EXPECT_TRUE(rosidl_runtime_c__double__Sequence__copy(&one, &other));
  EXPECT_EQ(other.data[0], 1.0);
  EXPECT_FALSE(rosidl_runtime_c__double__Sequence__init(nullptr, 1));
  rosidl_runtime_c__double__Sequence__fini(&one);
  rosidl_runtime_c__double__Sequence__fini(&other);
}

}  // namespace
