// SPDX-License-Identifier: Apache-2.0
// Turns the clouds of older programs, sensor_msgs/msg/PointCloud, into sensor_msgs/msg/PointCloud2, and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "sensor_msgs/msg/point_cloud.hpp"
#include "sensor_msgs/msg/point_cloud2.hpp"
#include "sensor_msgs/point_field_conversion.hpp"

namespace sensor_msgs {

// The position of a field, or -1.
inline int getPointCloud2FieldIndex(const msg::PointCloud2& cloud, const std::string& name) {
  for (std::size_t i = 0; i < cloud.fields.size(); ++i) {
    if (cloud.fields[i].name == name) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

// Each channel becomes a field of floats behind x, y and z.
inline bool convertPointCloudToPointCloud2(const msg::PointCloud& input, msg::PointCloud2& output) {
  output.header = input.header;
  output.width = static_cast<std::uint32_t>(input.points.size());
  output.height = 1;
  output.is_bigendian = false;
  output.is_dense = false;
  output.fields.assign(3 + input.channels.size(), msg::PointField());
  for (std::size_t i = 0; i < output.fields.size(); ++i) {
    msg::PointField& field = output.fields[i];
    field.name = i < 3 ? std::string(1, "xyz"[i]) : input.channels[i - 3].name;
    field.offset = static_cast<std::uint32_t>(4 * i);
    field.datatype = msg::PointField::FLOAT32;
    field.count = 1;
  }
  output.point_step = static_cast<std::uint32_t>(4 * output.fields.size());
  output.row_step = output.point_step * output.width;
  output.data.assign(output.row_step, 0);
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    std::uint8_t* point = output.data.data() + i * output.point_step;
    const float position[] = {input.points[i].x, input.points[i].y, input.points[i].z};
    std::memcpy(point, position, sizeof(position));
    for (std::size_t channel = 0; channel < input.channels.size(); ++channel) {
      if (input.channels[channel].values.size() == input.points.size()) {
        std::memcpy(point + 4 * (3 + channel), &input.channels[channel].values[i], 4);
      }
    }
  }
  return true;
}

// Every field beside x, y and z becomes a channel. False when one of them is missing.
inline bool convertPointCloud2ToPointCloud(const msg::PointCloud2& input, msg::PointCloud& output) {
  const int axes[] = {getPointCloud2FieldIndex(input, "x"), getPointCloud2FieldIndex(input, "y"),
                      getPointCloud2FieldIndex(input, "z")};
  if (axes[0] < 0 || axes[1] < 0 || axes[2] < 0) {
    return false;
  }
  const auto value = [&input](std::size_t point, const msg::PointField& field) {
    return readPointCloud2BufferValue<float>(input.data.data() + point * input.point_step + field.offset,
                                             field.datatype);
  };
  output.header = input.header;
  output.points.assign(std::size_t{input.width} * input.height, geometry_msgs::msg::Point32());
  for (std::size_t i = 0; i < output.points.size(); ++i) {
    output.points[i].x = value(i, input.fields[static_cast<std::size_t>(axes[0])]);
    output.points[i].y = value(i, input.fields[static_cast<std::size_t>(axes[1])]);
    output.points[i].z = value(i, input.fields[static_cast<std::size_t>(axes[2])]);
  }
  output.channels.clear();
  for (std::size_t field = 0; field < input.fields.size(); ++field) {
    if (static_cast<int>(field) == axes[0] || static_cast<int>(field) == axes[1] ||
        static_cast<int>(field) == axes[2]) {
      continue;
    }
    msg::ChannelFloat32& channel = output.channels.emplace_back();
    channel.name = input.fields[field].name;
    for (std::size_t i = 0; i < output.points.size(); ++i) {
      channel.values.push_back(value(i, input.fields[field]));
    }
  }
  return true;
}

}  // namespace sensor_msgs
