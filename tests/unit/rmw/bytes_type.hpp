// SPDX-License-Identifier: Apache-2.0
// A DDS type for tests with plain Fast DDS.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fastdds_versions/topic_type.hpp"

namespace rmw_test {

// Messages of any type as their bytes.
class Bytes final : public rmw_fastrtps::TopicTypeOf<Bytes> {
 public:
  explicit Bytes(const char* type_name) : TopicTypeOf(type_name, 4096) {}

  bool write(const void* data, rmw_fastrtps::rtps::SerializedPayload_t& payload) const {
    const auto& bytes = *static_cast<const std::vector<uint8_t>*>(data);
    std::copy(bytes.begin(), bytes.end(), payload.data);
    payload.length = static_cast<uint32_t>(bytes.size());
    payload.encapsulation = CDR_LE;
    return true;
  }
  bool read(const rmw_fastrtps::rtps::SerializedPayload_t& payload, void* data) const {
    static_cast<std::vector<uint8_t>*>(data)->assign(payload.data, payload.data + payload.length);
    return true;
  }
  uint32_t size_of(const void* data) const {
    return static_cast<uint32_t>(static_cast<const std::vector<uint8_t>*>(data)->size());
  }
  void* create() { return new std::vector<uint8_t>; }
  void destroy(void* data) { delete static_cast<std::vector<uint8_t>*>(data); }
};

}  // namespace rmw_test
