// SPDX-License-Identifier: Apache-2.0
// Serializes ROS messages for Fast DDS: an adapter from its TopicDataType to the type support callbacks.
#pragma once

#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <string>
#include <vector>

#include "rmw/serialized_message.h"
#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"

namespace rmw_fastrtps {

// The `data` of a write: exactly one of the two is set.
struct OutgoingMessage {
  const void* message = nullptr;
  const rmw_serialized_message_t* serialized = nullptr;
};

// The `data` of a take: exactly one of the two is set.
struct IncomingMessage {
  void* message = nullptr;
  rmw_serialized_message_t* serialized = nullptr;
};

class MessageType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit MessageType(const message_type_support_callbacks_t& callbacks);

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override;
  std::function<uint32_t()> getSerializedSizeProvider(void* data) override;
  bool is_bounded() const override { return is_bounded_; }
  // Whether messages can be created in the memory that they are sent from. A write may then take such a message as
  // `data`.
  bool is_plain() const override { return is_plain_; }

  // Fast DDS never creates samples: takes always bring their own memory.
  void* createData() override { return nullptr; }
  void deleteData(void*) override {}

  // ROS topics have no keys.
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }

 private:
  const message_type_support_callbacks_t& callbacks_;
  bool is_bounded_ = false;
  bool is_plain_ = false;
};

// The bytes of a message, with the encapsulation header; empty if it cannot be serialized.
std::vector<std::uint8_t> to_bytes(const message_type_support_callbacks_t& callbacks, const OutgoingMessage& message);
// False if the bytes are no message of this type.
bool from_bytes(const message_type_support_callbacks_t& callbacks, const std::vector<std::uint8_t>& bytes,
                const IncomingMessage& message);

// Whether a message has the same layout in memory and on the wire.
bool is_plain(const message_type_support_callbacks_t& callbacks);

// `std_msgs::msg::dds_::String_`
std::string dds_type_name(const message_type_support_callbacks_t& callbacks);

// The callbacks of a type support. Throws std::runtime_error if the type support is of another kind.
const message_type_support_callbacks_t& callbacks_of(const rosidl_message_type_support_t* type_support);

}  // namespace rmw_fastrtps
