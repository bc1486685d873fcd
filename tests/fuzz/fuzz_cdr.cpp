// SPDX-License-Identifier: Apache-2.0
// The bytes of messages from untrusted senders, read as C++ and as C messages of several types.
//
// Both must agree on what is a message and on its bytes, and neither may take more memory than a multiple of the bytes
// there. The first byte of the input chooses the type.
#include <sanitizer/allocator_interface.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "fastcdr_versions/cdr.hpp"
#include "rcl_interfaces/srv/set_parameters.h"
#include "rcl_interfaces/srv/set_parameters.hpp"
#include "rmw_dds_common/msg/participant_entities_info.h"
#include "rmw_dds_common/msg/participant_entities_info.hpp"
#include "rosidl_typesupport_fastrtps_cpp/find_callbacks.hpp"
#include "sensor_msgs/msg/point_cloud2.h"
#include "sensor_msgs/msg/point_cloud2.hpp"
#include "test_msgs/action/nested_message.h"
#include "test_msgs/action/nested_message.hpp"
#include "test_msgs/msg/arrays.h"
#include "test_msgs/msg/arrays.hpp"
#include "test_msgs/msg/bounded_sequences.h"
#include "test_msgs/msg/bounded_sequences.hpp"
#include "test_msgs/msg/multi_nested.h"
#include "test_msgs/msg/multi_nested.hpp"
#include "test_msgs/msg/w_strings.h"
#include "test_msgs/msg/w_strings.hpp"

namespace {

using Callbacks = message_type_support_callbacks_t;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;
using rosidl_typesupport_cpp::get_message_type_support_handle;
using rosidl_typesupport_fastrtps_cpp::find_callbacks;

struct Type {
  const rosidl_message_type_support_t* cpp;
  const rosidl_message_type_support_t* c;
};

const std::array<Type, 8>& types() {
  static const std::array<Type, 8> kTypes{
      {{get_message_type_support_handle<rcl_interfaces::srv::SetParameters_Request>(),
        ROSIDL_GET_MSG_TYPE_SUPPORT(rcl_interfaces, srv, SetParameters_Request)},
       {get_message_type_support_handle<rmw_dds_common::msg::ParticipantEntitiesInfo>(),
        ROSIDL_GET_MSG_TYPE_SUPPORT(rmw_dds_common, msg, ParticipantEntitiesInfo)},
       {get_message_type_support_handle<sensor_msgs::msg::PointCloud2>(),
        ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, PointCloud2)},
       {get_message_type_support_handle<test_msgs::action::NestedMessage_FeedbackMessage>(),
        ROSIDL_GET_MSG_TYPE_SUPPORT(test_msgs, action, NestedMessage_FeedbackMessage)},
       {get_message_type_support_handle<test_msgs::msg::Arrays>(), ROSIDL_GET_MSG_TYPE_SUPPORT(test_msgs, msg, Arrays)},
       {get_message_type_support_handle<test_msgs::msg::BoundedSequences>(),
        ROSIDL_GET_MSG_TYPE_SUPPORT(test_msgs, msg, BoundedSequences)},
       {get_message_type_support_handle<test_msgs::msg::MultiNested>(),
        ROSIDL_GET_MSG_TYPE_SUPPORT(test_msgs, msg, MultiNested)},
       {get_message_type_support_handle<test_msgs::msg::WStrings>(),
        ROSIDL_GET_MSG_TYPE_SUPPORT(test_msgs, msg, WStrings)}}};
  return kTypes;
}

// A message of text and numbers in memory is larger than its bytes: an empty string has 4 bytes and 32 in memory, and
// an element with defaults is made with them before it is read.
constexpr std::size_t kMostMemoryPerByte = 48;
constexpr std::size_t kMostMemory = 256 * 1024;

[[noreturn]] void finding(const char* what, const Callbacks& type) {
  std::fprintf(stderr, "%s: %s\n", type.message_name_, what);
  std::abort();
}

struct Result {
  bool is_message = false;
  std::vector<char> bytes;  // of the message that was read
};

Result read_and_write(const Callbacks& type, std::vector<char> input) {
  Result result;
  void* message = type.create_message();
  FastBuffer buffer(input.data(), input.size());
  Cdr cdr = fastcdr_versions::plain_cdr(buffer, Cdr::LITTLE_ENDIANNESS);
  const std::size_t before = __sanitizer_get_current_allocated_bytes();
  result.is_message = type.cdr_deserialize(cdr, message);
  const std::size_t after = __sanitizer_get_current_allocated_bytes();
  if (after > before + kMostMemory + kMostMemoryPerByte * input.size()) {
    finding("takes more memory than its bytes allow", type);
  }
  if (result.is_message) {
    result.bytes.resize(type.get_serialized_size(message));
    FastBuffer output(result.bytes.data(), result.bytes.size());
    Cdr writer = fastcdr_versions::plain_cdr(output, Cdr::LITTLE_ENDIANNESS);
    if (!type.cdr_serialize(message, writer) || fastcdr_versions::written_size(writer) != result.bytes.size()) {
      finding("is read and cannot be written", type);
    }
  }
  type.destroy_message(message);
  return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return -1;
  }
  const Type& type = types()[data[0] % types().size()];
  const std::vector<char> input(data + 1, data + size);
  const Callbacks& cpp = *find_callbacks(type.cpp);
  const Result result = read_and_write(cpp, input);
  const Result result_of_c = read_and_write(*find_callbacks(type.c), input);
  if (result.is_message != result_of_c.is_message) {
    finding("C and C++ do not agree on what is a message", cpp);
  }
  if (result.bytes != result_of_c.bytes) {
    finding("C and C++ write other bytes", cpp);
  }
  if (result.is_message && read_and_write(cpp, result.bytes).bytes != result.bytes) {
    finding("the bytes that were written are read as another message", cpp);
  }
  return 0;
}
