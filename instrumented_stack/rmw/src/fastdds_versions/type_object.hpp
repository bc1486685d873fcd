// SPDX-License-Identifier: Apache-2.0
// The structure of a message type, which the content filters of Fast DDS need.
#pragma once

#include <string>
#include <string_view>

#include "rosidl_runtime_c/type_description.h"

namespace rmw_fastrtps {

// Registers the members of a type with Fast DDS, once per process. Thread safe. Throws std::runtime_error.
void register_type_object(const rosidl_type_description_t& description);

// What both versions need for it:

// A type_id of type_description_interfaces/msg/FieldType is one of these, plus an offset for arrays and sequences.
enum Element : unsigned {
  kNested = 1,
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat,
  kDouble,
  kBoolean = 15,
  kByte,
  kString,
  kWstring,
  kBoundedString = 21,
  kBoundedWstring,
};
enum Many : unsigned { kOne, kArray, kBoundedSequence, kUnboundedSequence };
constexpr unsigned kManyFactor = 48;

// std_msgs/msg/Header → std_msgs::msg::dds_::Header_
inline std::string dds_name(std::string_view type_name) {
  const std::size_t first = type_name.find('/');
  const std::size_t last = type_name.rfind('/');
  return std::string(type_name.substr(0, first)) + "::" + std::string(type_name.substr(first + 1, last - first - 1)) +
         "::dds_::" + std::string(type_name.substr(last + 1)) + "_";
}

}  // namespace rmw_fastrtps
