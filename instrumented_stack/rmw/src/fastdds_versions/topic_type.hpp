// SPDX-License-Identifier: Apache-2.0
// A type without keys, as Fast DDS wants to know it. Version 2 passes pointers, asks for a function that tells the
// size, and has a member with the largest size. Version 3 passes references and the representation, which is plain CDR.
#pragma once

#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <string>

#include "fastdds_versions/names.hpp"

namespace rmw_fastrtps {

// `Type` derives from it and has these functions:
//   bool write(const void* data, rtps::SerializedPayload_t& payload) const;        sets length and encapsulation
//   bool read(const rtps::SerializedPayload_t& payload, void* data) const;
//   std::uint32_t size_of(const void* data) const;                                 with the encapsulation header
// For a type with samples that Fast DDS makes: create() and destroy(). Otherwise takes bring their own memory.
template <typename Type>
class TopicTypeOf : public fdds::TopicDataType {
 public:
  TopicTypeOf(const std::string& name, std::uint32_t largest_size) {
#if RMW_FASTDDS_MAJOR >= 3
    set_name(name);
    max_serialized_type_size = largest_size;
#else
    setName(name.c_str());
    m_typeSize = largest_size;
#endif
  }

  void* create() { return nullptr; }
  void destroy(void*) {}

#if RMW_FASTDDS_MAJOR >= 3
  [[gnu::hot]] bool serialize(const void* data, rtps::SerializedPayload_t& payload,
                              fdds::DataRepresentationId_t representation) override {
    return representation == fdds::XCDR_DATA_REPRESENTATION && self().write(data, payload);
  }
  [[gnu::hot]] bool deserialize(rtps::SerializedPayload_t& payload, void* data) override {
    return self().read(payload, data);
  }
  [[gnu::hot]] std::uint32_t calculate_serialized_size(const void* data, fdds::DataRepresentationId_t) override {
    return self().size_of(data);
  }
  bool compute_key(rtps::SerializedPayload_t&, rtps::InstanceHandle_t&, bool) override { return false; }
  bool compute_key(const void*, rtps::InstanceHandle_t&, bool) override { return false; }
  void* create_data() override { return self().create(); }
  void delete_data(void* data) override { self().destroy(data); }
  // Fast DDS asks for XCDR2 as well, because the reader's QoS names no representation. It would want samples from
  // create() for a loan if the answer was no. Nodes of ROS 2 with Fast DDS write plain CDR.
  bool is_plain(fdds::DataRepresentationId_t) const override { return has_plain_memory(); }
#else
  using TopicDataType::getSerializedSizeProvider;
  using TopicDataType::is_plain;
  using TopicDataType::serialize;
  [[gnu::hot]] bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    return self().write(data, *payload);
  }
  [[gnu::hot]] bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    return self().read(*payload, data);
  }
  [[gnu::hot]] std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    // Two pointers fit into a std::function without allocation.
    return [type = &self(), data] { return type->size_of(data); };
  }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
  void* createData() override { return self().create(); }
  void deleteData(void* data) override { self().destroy(data); }
  bool is_plain() const override { return has_plain_memory(); }
#endif

 protected:
  // Whether messages can be created in the memory that they are sent from. A write may then take such a message as
  // `data`.
  virtual bool has_plain_memory() const { return false; }

 private:
  Type& self() { return static_cast<Type&>(*this); }
};

}  // namespace rmw_fastrtps
