// SPDX-License-Identifier: Apache-2.0
#include "types/message_type.hpp"

#include <fastcdr/exceptions/Exception.h>

#include <cstring>
#include <stdexcept>

#include "fastcdr_versions/cdr.hpp"
#include "rmw/error_handling.h"
#include "rmw/rmw.h"
#include "rosidl_typesupport_fastrtps_cpp/find_callbacks.hpp"

namespace rmw_fastrtps {
namespace {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

constexpr std::uint32_t kEncapsulationSize = 4;

// The number of bytes written with the encapsulation header; 0 if the buffer is too small.
[[gnu::hot]] std::uint32_t to_cdr(const message_type_support_callbacks_t& callbacks, const void* message, void* buffer,
                                  std::size_t capacity) {
  FastBuffer memory(static_cast<char*>(buffer), capacity);
  Cdr cdr = fastcdr_versions::plain_cdr(memory);
  try {
    cdr.serialize_encapsulation();
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return 0;
  }
  return callbacks.cdr_serialize(message, cdr) ? static_cast<std::uint32_t>(fastcdr_versions::written_size(cdr)) : 0;
}

[[gnu::hot]] bool from_cdr(const message_type_support_callbacks_t& callbacks, const void* buffer, std::size_t length,
                           void* message) {
  // Fast CDR has one buffer type for both directions. Reading does not write to it.
  FastBuffer memory(static_cast<char*>(const_cast<void*>(buffer)), length);
  Cdr cdr = fastcdr_versions::plain_cdr(memory);
  try {
    cdr.read_encapsulation();
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return false;
  }
  return callbacks.cdr_deserialize(cdr, message);
}

bool assign(rmw_serialized_message_t& target, const void* bytes, std::size_t length) {
  if (target.buffer_capacity < length && rmw_serialized_message_resize(&target, length) != RCUTILS_RET_OK) {
    return false;
  }
  std::memcpy(target.buffer, bytes, length);
  target.buffer_length = length;
  return true;
}

}  // namespace

MessageType::Layout::Layout(const message_type_support_callbacks_t& callbacks) {
  char bounds = 0;
  const std::size_t size = callbacks.max_serialized_size(bounds);
  is_bounded = bounds != ROSIDL_TYPESUPPORT_FASTRTPS_UNBOUNDED_TYPE;
  is_plain = bounds == ROSIDL_TYPESUPPORT_FASTRTPS_PLAIN_TYPE;
  // Submessages of RTPS are aligned to four bytes. A plain message in memory may end with padding.
  const std::uint32_t alignment = is_plain ? 8 : 4;
  const std::uint32_t rounded = (static_cast<std::uint32_t>(size) + alignment - 1) / alignment * alignment;
  largest_size = kEncapsulationSize + rounded;
}

MessageType::MessageType(const message_type_support_callbacks_t& callbacks)
    : MessageType(callbacks, Layout(callbacks)) {}

MessageType::MessageType(const message_type_support_callbacks_t& callbacks, const Layout& layout)
    : TopicTypeOf(dds_type_name(callbacks), layout.largest_size), layout_(layout) {}

[[gnu::hot]] bool MessageType::write(const void* data, rtps::SerializedPayload_t& payload) const {
  const auto& outgoing = *static_cast<const OutgoingMessage*>(data);
  payload.encapsulation = CDR_LE;
  if (outgoing.serialized != nullptr) {
    if (outgoing.serialized->buffer_length > payload.max_size) {
      return false;
    }
    payload.length = static_cast<std::uint32_t>(outgoing.serialized->buffer_length);
    std::memcpy(payload.data, outgoing.serialized->buffer, payload.length);
    return true;
  }
  payload.length = to_cdr(*outgoing.callbacks, outgoing.message, payload.data, payload.max_size);
  return payload.length != 0;
}

[[gnu::hot]] bool MessageType::read(const rtps::SerializedPayload_t& payload, void* data) const {
  const auto& incoming = *static_cast<const IncomingMessage*>(data);
  if (incoming.serialized != nullptr) {
    return assign(*incoming.serialized, payload.data, payload.length);
  }
  return from_cdr(*incoming.callbacks, payload.data, payload.length, incoming.message);
}

[[gnu::hot]] std::uint32_t MessageType::size_of(const void* data) const {
  const auto& outgoing = *static_cast<const OutgoingMessage*>(data);
  if (outgoing.serialized != nullptr) {
    return static_cast<std::uint32_t>(outgoing.serialized->buffer_length);
  }
  return layout_.is_bounded ? layout_.largest_size
                            : kEncapsulationSize + outgoing.callbacks->get_serialized_size(outgoing.message);
}

std::vector<std::uint8_t> to_bytes(const message_type_support_callbacks_t& callbacks, const OutgoingMessage& message) {
  if (message.serialized != nullptr) {
    return {message.serialized->buffer, message.serialized->buffer + message.serialized->buffer_length};
  }
  std::vector<std::uint8_t> bytes(kEncapsulationSize + callbacks.get_serialized_size(message.message));
  bytes.resize(to_cdr(callbacks, message.message, bytes.data(), bytes.size()));
  return bytes;
}

bool from_bytes(const message_type_support_callbacks_t& callbacks, const std::vector<std::uint8_t>& bytes,
                const IncomingMessage& message) {
  return message.serialized != nullptr ? assign(*message.serialized, bytes.data(), bytes.size())
                                       : from_cdr(callbacks, bytes.data(), bytes.size(), message.message);
}

bool is_plain(const message_type_support_callbacks_t& callbacks) {
  char bounds = 0;
  (void)callbacks.max_serialized_size(bounds);
  return bounds == ROSIDL_TYPESUPPORT_FASTRTPS_PLAIN_TYPE;
}

std::string dds_type_name(const message_type_support_callbacks_t& callbacks) {
  return std::string(callbacks.message_namespace_) + "::dds_::" + callbacks.message_name_ + "_";
}

const message_type_support_callbacks_t& callbacks_of(const rosidl_message_type_support_t* type_support) {
  const auto* found = rosidl_typesupport_fastrtps_cpp::find_callbacks(type_support);
  if (found == nullptr) {
    throw std::runtime_error(std::string("the type support is of kind '") + type_support->typesupport_identifier +
                             "', but must lead to '" + rosidl_typesupport_fastrtps_cpp::typesupport_identifier + "'");
  }
  return *found;
}

}  // namespace rmw_fastrtps

rmw_ret_t rmw_serialize(const void* ros_message, const rosidl_message_type_support_t* type_support,
                        rmw_serialized_message_t* serialized_message) try {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_message, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(serialized_message, RMW_RET_INVALID_ARGUMENT);
  const auto& callbacks = rmw_fastrtps::callbacks_of(type_support);
  const std::size_t size = rmw_fastrtps::kEncapsulationSize + callbacks.get_serialized_size(ros_message);
  if (serialized_message->buffer_capacity < size &&
      rmw_serialized_message_resize(serialized_message, size) != RCUTILS_RET_OK) {
    return RMW_RET_BAD_ALLOC;
  }
  serialized_message->buffer_length =
      rmw_fastrtps::to_cdr(callbacks, ros_message, serialized_message->buffer, serialized_message->buffer_capacity);
  if (serialized_message->buffer_length == 0) {
    RMW_SET_ERROR_MSG("the message cannot be serialized");
    return RMW_RET_ERROR;
  }
  return RMW_RET_OK;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return RMW_RET_ERROR;
}

rmw_ret_t rmw_deserialize(const rmw_serialized_message_t* serialized_message,
                          const rosidl_message_type_support_t* type_support, void* ros_message) try {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(serialized_message, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_message, RMW_RET_INVALID_ARGUMENT);
  if (!rmw_fastrtps::from_cdr(rmw_fastrtps::callbacks_of(type_support), serialized_message->buffer,
                              serialized_message->buffer_length, ros_message)) {
    RMW_SET_ERROR_MSG("the bytes are no serialized message of this type");
    return RMW_RET_ERROR;
  }
  return RMW_RET_OK;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return RMW_RET_ERROR;
}
