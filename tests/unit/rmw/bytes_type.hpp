// SPDX-License-Identifier: Apache-2.0
// A DDS type for tests with plain Fast DDS.
#pragma once

#include <algorithm>
#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <vector>

namespace rmw_test {

// Messages of any type as their bytes.
class Bytes final : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit Bytes(const char* type_name) {
    setName(type_name);
    m_typeSize = 4096;
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<const std::vector<uint8_t>*>(data);
    std::copy(bytes.begin(), bytes.end(), payload->data);
    payload->length = static_cast<uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<std::vector<uint8_t>*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<uint32_t>(static_cast<const std::vector<uint8_t>*>(data)->size()); };
  }
  void* createData() override { return new std::vector<uint8_t>; }
  void deleteData(void* data) override { delete static_cast<std::vector<uint8_t>*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

}  // namespace rmw_test
