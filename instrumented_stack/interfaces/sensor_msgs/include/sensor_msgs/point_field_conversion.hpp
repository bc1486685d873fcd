// SPDX-License-Identifier: Apache-2.0
// The types that sensor_msgs/msg/PointField names, and values of them in the bytes of a cloud.
#pragma once

#include <cstdint>
#include <cstring>

#include "sensor_msgs/msg/point_field.hpp"

namespace sensor_msgs {

// The type of a datatype, as `type`.
template <int datatype>
struct pointFieldTypeAsType {};

// The datatype of a type, as `value`.
template <typename T>
struct typeAsPointFieldType {};

// NOLINTBEGIN: a macro, because each row makes two specializations
#define SENSOR_MSGS_POINT_FIELD_TYPE(datatype, cpp_type)         \
  template <>                                                    \
  struct pointFieldTypeAsType<msg::PointField::datatype> {       \
    using type = cpp_type;                                       \
  };                                                             \
  template <>                                                    \
  struct typeAsPointFieldType<cpp_type> {                        \
    static const std::uint8_t value = msg::PointField::datatype; \
  };
SENSOR_MSGS_POINT_FIELD_TYPE(INT8, std::int8_t)
SENSOR_MSGS_POINT_FIELD_TYPE(UINT8, std::uint8_t)
SENSOR_MSGS_POINT_FIELD_TYPE(INT16, std::int16_t)
SENSOR_MSGS_POINT_FIELD_TYPE(UINT16, std::uint16_t)
SENSOR_MSGS_POINT_FIELD_TYPE(INT32, std::int32_t)
SENSOR_MSGS_POINT_FIELD_TYPE(UINT32, std::uint32_t)
SENSOR_MSGS_POINT_FIELD_TYPE(FLOAT32, float)
SENSOR_MSGS_POINT_FIELD_TYPE(FLOAT64, double)
#undef SENSOR_MSGS_POINT_FIELD_TYPE
// NOLINTEND

// Reads a value of `datatype` and converts it. The bytes need no alignment.
template <int datatype, typename T>
T readPointCloud2BufferValue(const unsigned char* bytes) {
  typename pointFieldTypeAsType<datatype>::type value;
  std::memcpy(&value, bytes, sizeof(value));
  return static_cast<T>(value);
}

// Does so for a datatype that is known only at run time; T() if there is no such datatype.
template <typename T>
T readPointCloud2BufferValue(const unsigned char* bytes, unsigned char datatype) {
  switch (datatype) {
    case msg::PointField::INT8:
      return readPointCloud2BufferValue<msg::PointField::INT8, T>(bytes);
    case msg::PointField::UINT8:
      return readPointCloud2BufferValue<msg::PointField::UINT8, T>(bytes);
    case msg::PointField::INT16:
      return readPointCloud2BufferValue<msg::PointField::INT16, T>(bytes);
    case msg::PointField::UINT16:
      return readPointCloud2BufferValue<msg::PointField::UINT16, T>(bytes);
    case msg::PointField::INT32:
      return readPointCloud2BufferValue<msg::PointField::INT32, T>(bytes);
    case msg::PointField::UINT32:
      return readPointCloud2BufferValue<msg::PointField::UINT32, T>(bytes);
    case msg::PointField::FLOAT32:
      return readPointCloud2BufferValue<msg::PointField::FLOAT32, T>(bytes);
    case msg::PointField::FLOAT64:
      return readPointCloud2BufferValue<msg::PointField::FLOAT64, T>(bytes);
    default:
      return T();
  }
}

// Writes a value as `datatype`.
template <int datatype, typename T>
void writePointCloud2BufferValue(unsigned char* bytes, T value) {
  const auto converted = static_cast<typename pointFieldTypeAsType<datatype>::type>(value);
  std::memcpy(bytes, &converted, sizeof(converted));
}

}  // namespace sensor_msgs
