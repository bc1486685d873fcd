// SPDX-License-Identifier: Apache-2.0
// Lays out the points of sensor_msgs/msg/PointCloud2, and goes through one of their fields.
#pragma once

#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "sensor_msgs/msg/point_cloud2.hpp"
#include "sensor_msgs/msg/point_field.hpp"

namespace sensor_msgs {

namespace impl {

// The bytes of a value. Throws std::runtime_error when there is no such datatype.
inline std::uint32_t size_of_point_field(int datatype) {
  switch (datatype) {
    case msg::PointField::INT8:
    case msg::PointField::UINT8:
      return 1;
    case msg::PointField::INT16:
    case msg::PointField::UINT16:
      return 2;
    case msg::PointField::INT32:
    case msg::PointField::UINT32:
    case msg::PointField::FLOAT32:
      return 4;
    case msg::PointField::FLOAT64:
      return 8;
    default:
      throw std::runtime_error("PointField of type " + std::to_string(datatype) + " does not exist");
  }
}

// The first byte of a field within a point. "r", "g", "b" and "a" are bytes of the field "rgb" or "rgba", too.
inline std::uint32_t point_field_offset(const msg::PointCloud2& cloud, const std::string& name) {
  for (const msg::PointField& field : cloud.fields) {
    if (field.name == name) {
      return field.offset;
    }
  }
  const std::size_t channel = name.size() == 1 ? std::string("bgra").find(name) : std::string::npos;
  if (channel != std::string::npos) {
    for (const msg::PointField& field : cloud.fields) {
      if (field.name == "rgb" || field.name == "rgba") {
        return field.offset + static_cast<std::uint32_t>(cloud.is_bigendian ? 3 - channel : channel);
      }
    }
  }
  throw std::runtime_error("Field " + name + " does not exist");
}

// Goes from point to point. `Element` is the type of the value, const for a cloud that must not change.
template <typename Element, typename Byte, typename Cloud, typename Derived>
class PointCloud2IteratorBase {
 public:
  PointCloud2IteratorBase() = default;
  PointCloud2IteratorBase(Cloud& cloud, const std::string& field)
      : step_(cloud.point_step), is_bigendian_(cloud.is_bigendian) {
    const std::uint32_t offset = point_field_offset(cloud, field);
    at_ = cloud.data.data() + offset;
    end_ = cloud.data.data() + cloud.data.size() + offset;
  }

  // The elements of a field with several of them.
  Element& operator[](std::size_t index) const { return reinterpret_cast<Element*>(at_)[index]; }
  Element& operator*() const { return *reinterpret_cast<Element*>(at_); }

  Derived& operator++() { return *this += 1; }
  Derived& operator+=(int points) {
    at_ += std::ptrdiff_t{points} * step_;
    return static_cast<Derived&>(*this);
  }
  Derived operator+(int points) const {
    Derived result = static_cast<const Derived&>(*this);
    result += points;
    return result;
  }

  bool operator==(const Derived& other) const { return at_ == other.at_; }
  bool operator!=(const Derived& other) const { return at_ != other.at_; }

  // The position behind the last point.
  Derived end() const {
    Derived result = static_cast<const Derived&>(*this);
    result.at_ = end_;
    return result;
  }

 protected:
  Byte* at_ = nullptr;
  Byte* end_ = nullptr;
  std::ptrdiff_t step_ = 0;
  bool is_bigendian_ = false;
};

}  // namespace impl

// Goes through the values of a field: `PointCloud2Iterator<float> x(cloud, "x")`. The cloud must outlive it unchanged
// in size.
template <typename T>
class PointCloud2Iterator
    : public impl::PointCloud2IteratorBase<T, unsigned char, msg::PointCloud2, PointCloud2Iterator<T>> {
 public:
  using impl::PointCloud2IteratorBase<T, unsigned char, msg::PointCloud2,
                                      PointCloud2Iterator<T>>::PointCloud2IteratorBase;
};

template <typename T>
class PointCloud2ConstIterator
    : public impl::PointCloud2IteratorBase<const T, const unsigned char, const msg::PointCloud2,
                                           PointCloud2ConstIterator<T>> {
 public:
  using impl::PointCloud2IteratorBase<const T, const unsigned char, const msg::PointCloud2,
                                      PointCloud2ConstIterator<T>>::PointCloud2IteratorBase;
};

// Changes the fields and the size of a cloud.
class PointCloud2Modifier {
 public:
  explicit PointCloud2Modifier(msg::PointCloud2& cloud) : cloud_msg_(cloud) {}

  // The number of points.
  std::size_t size() const { return cloud_msg_.data.size() / cloud_msg_.point_step; }
  void reserve(std::size_t points) { cloud_msg_.data.reserve(points * cloud_msg_.point_step); }

  // Makes room for so many points. A cloud with rows and columns becomes a single row, if the number changes.
  void resize(std::size_t points) {
    const std::size_t bytes = points * cloud_msg_.point_step;
    const bool changes = std::size_t{cloud_msg_.height} * cloud_msg_.width != points;
    cloud_msg_.data.resize(bytes);
    if (!changes) {
      return;
    }
    if (cloud_msg_.height != 1 && cloud_msg_.width == 1) {
      cloud_msg_.height = static_cast<std::uint32_t>(points);
      return;
    }
    cloud_msg_.height = 1;
    cloud_msg_.width = static_cast<std::uint32_t>(points);
    cloud_msg_.row_step = static_cast<std::uint32_t>(bytes);
  }

  void resize(std::uint32_t width, std::uint32_t height) {
    cloud_msg_.data.resize(std::size_t{width} * height * cloud_msg_.point_step);
    cloud_msg_.width = width;
    cloud_msg_.height = height;
    cloud_msg_.row_step = width * cloud_msg_.point_step;
  }

  // Removes all points.
  void clear() {
    cloud_msg_.data.clear();
    if (cloud_msg_.height != 1 && cloud_msg_.width == 1) {
      cloud_msg_.height = 0;
      return;
    }
    if (cloud_msg_.height != 1) {
      cloud_msg_.height = 0;
    }
    cloud_msg_.width = 0;
    cloud_msg_.row_step = 0;
  }

  // Sets the fields. Behind their number come name (const char*), count and datatype (int) of each, without padding:
  // `setPointCloud2Fields(2, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32)`.
  void setPointCloud2Fields(int number, ...) {
    cloud_msg_.fields.clear();
    std::uint32_t offset = 0;
    std::va_list arguments;
    va_start(arguments, number);
    for (int i = 0; i < number; ++i) {
      const char* name = va_arg(arguments, const char*);
      const int count = va_arg(arguments, int);
      const int datatype = va_arg(arguments, int);
      offset = add_field(name, count, datatype, offset);
    }
    va_end(arguments);
    lay_out(offset);
  }

  // Sets the fields by names: "xyz" are three floats, "rgb" and "rgba" four bytes in a float. Each is padded to 16
  // bytes. Throws std::runtime_error for another name.
  void setPointCloud2FieldsByString(int number, ...) {
    cloud_msg_.fields.clear();
    std::uint32_t offset = 0;
    std::va_list arguments;
    va_start(arguments, number);
    for (int i = 0; i < number; ++i) {
      const std::string name = va_arg(arguments, const char*);
      if (name == "xyz") {
        for (const char* axis : {"x", "y", "z"}) {
          offset = add_field(axis, 1, msg::PointField::FLOAT32, offset);
        }
        offset += 4;
      } else if (name == "rgb" || name == "rgba") {
        offset = add_field(name, 1, msg::PointField::FLOAT32, offset) + 12;
      } else {
        va_end(arguments);
        throw std::runtime_error("Field " + name + " does not exist");
      }
    }
    va_end(arguments);
    lay_out(offset);
  }

 protected:
  msg::PointCloud2& cloud_msg_;

 private:
  // Returns the offset of the next field.
  std::uint32_t add_field(const std::string& name, int count, int datatype, std::uint32_t offset) {
    msg::PointField& field = cloud_msg_.fields.emplace_back();
    field.name = name;
    field.count = static_cast<std::uint32_t>(count);
    field.datatype = static_cast<std::uint8_t>(datatype);
    field.offset = offset;
    return offset + field.count * impl::size_of_point_field(datatype);
  }

  void lay_out(std::uint32_t point_step) {
    cloud_msg_.point_step = point_step;
    cloud_msg_.row_step = cloud_msg_.width * point_step;
    cloud_msg_.data.resize(std::size_t{cloud_msg_.height} * cloud_msg_.row_step);
  }
};

}  // namespace sensor_msgs
