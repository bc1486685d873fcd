// SPDX-License-Identifier: Apache-2.0
// Fills sensor_msgs/msg/Image from memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "sensor_msgs/image_encodings.hpp"
#include "sensor_msgs/msg/image.hpp"

namespace sensor_msgs {

// Copies `rows` rows of `step` bytes into the image. The header stays as it is.
inline bool fillImage(msg::Image& image, const std::string& encoding, std::uint32_t rows, std::uint32_t columns,
                      std::uint32_t step, const void* data) {
  image.encoding = encoding;
  image.height = rows;
  image.width = columns;
  image.step = step;
  image.is_bigendian = 0;
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  image.data.assign(bytes, bytes + std::size_t{step} * rows);
  return true;
}

// Empties the data of the image; its other fields stay as they are.
inline void clearImage(msg::Image& image) {
  image.data.clear();
}

}  // namespace sensor_msgs
