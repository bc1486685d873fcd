// SPDX-License-Identifier: Apache-2.0
// Serializes ROS messages for Fast DDS: an adapter from its TopicDataType to the type support callbacks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fastdds_versions/topic_type.hpp"
#include "rmw/serialized_message.h"
#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"

namespace rmw_fastrtps {

// The `data` of a write: a message and the callbacks of its type support, or its bytes. Endpoints of one type may have
// messages of C and of C++, but Fast DDS knows one MessageType for them.
struct OutgoingMessage {
  const void* message = nullptr;
  const rmw_serialized_message_t* serialized = nullptr;
  const message_type_support_callbacks_t* callbacks = nullptr;
};

// The `data` of a take, likewise.
struct IncomingMessage {
  void* message = nullptr;
  rmw_serialized_message_t* serialized = nullptr;
  const message_type_support_callbacks_t* callbacks = nullptr;
};

class MessageType final : public TopicTypeOf<MessageType> {
 public:
  explicit MessageType(const message_type_support_callbacks_t& callbacks);

  bool write(const void* data, rtps::SerializedPayload_t& payload) const;
  bool read(const rtps::SerializedPayload_t& payload, void* data) const;
  std::uint32_t size_of(const void* data) const;

  bool is_bounded() const override { return layout_.is_bounded; }

 private:
  struct Layout {
    explicit Layout(const message_type_support_callbacks_t& callbacks);

    bool is_bounded = false;
    bool is_plain = false;
    std::uint32_t largest_size = 0;  // with the encapsulation header
  };

  MessageType(const message_type_support_callbacks_t& callbacks, const Layout& layout);

  bool has_plain_memory() const override { return layout_.is_plain; }

  const Layout layout_;
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
