// SPDX-License-Identifier: Apache-2.0
// Converts a message to its bytes and back, also if its type is known only at run time.
#pragma once

#include <rosidl_runtime_c/message_type_support_struct.h>

#include <memory>
#include <rosidl_typesupport_cpp/message_type_support.hpp>

#include "rclcpp/serialized_message.hpp"

namespace rclcpp {

class SerializationBase {
 public:
  explicit SerializationBase(const rosidl_message_type_support_t* type_support) : type_support_(type_support) {}
  virtual ~SerializationBase() = default;

  // `ros_message` points to a message of this object's type. Throw exceptions::RCLError if the bytes are not such a
  // message.
  void serialize_message(const void* ros_message, SerializedMessage* serialized_message) const;
  void deserialize_message(const SerializedMessage* serialized_message, void* ros_message) const;

 private:
  const rosidl_message_type_support_t* type_support_;
};

template <typename MessageT>
class Serialization : public SerializationBase {
 public:
  Serialization() : SerializationBase(rosidl_typesupport_cpp::get_message_type_support_handle<MessageT>()) {}
};

namespace detail {

// A message with the defaults of its type. Throws exceptions::RCLError if the type support cannot make one.
std::shared_ptr<void> make_message(const rosidl_message_type_support_t& type_support);

}  // namespace detail

}  // namespace rclcpp
