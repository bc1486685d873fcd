// SPDX-License-Identifier: Apache-2.0
// What the floors on bare Fast DDS share: messages, and the quality of service that the stack's rmw asks for.
#pragma once

#include <fastcdr/Cdr.h>

#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <mutex>
#include <string>

#include "worker.hpp"

namespace latency {

namespace fdds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

// Any of the message types; the size decides the length of `data`.
struct Message {
  std::int64_t sent;
  std::int64_t remaining;
  std::uint8_t data[kSizes.back() - 2 * sizeof(std::int64_t)];
};

// A type whose messages have `size` bytes.
class MessageType final : public fdds::TopicDataType {
 public:
  explicit MessageType(std::size_t size) : length_(size - 2 * sizeof(std::int64_t)) {
    setName(("Bytes" + std::to_string(size)).c_str());
    m_typeSize = static_cast<std::uint32_t>(size) + kEncapsulation;
  }

  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const Message& message = *static_cast<const Message*>(data);
    FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    payload->encapsulation = CDR_LE;
    cdr.serialize_encapsulation();
    cdr << message.sent << message.remaining;
    cdr.serializeArray(message.data, length_);
    payload->length = static_cast<std::uint32_t>(cdr.getSerializedDataLength());
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    Message& message = *static_cast<Message*>(data);
    FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.read_encapsulation();
    cdr >> message.sent >> message.remaining;
    cdr.deserializeArray(message.data, length_);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [this] { return m_typeSize; };
  }
  void* createData() override { return new Message; }
  void deleteData(void* data) override { delete static_cast<Message*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
  bool is_bounded() const override { return true; }

 private:
  static constexpr std::uint32_t kEncapsulation = 4;
  std::size_t length_;
};

template <typename Qos>
Qos like_rmw(Qos qos) {
  qos.history().kind = fdds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = kDepth;
  qos.reliability().kind = fdds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = fdds::VOLATILE_DURABILITY_QOS;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  return qos;
}

// Counts the other sides that endpoints have found.
class Matches {
 public:
  explicit Matches(int wanted) : wanted_(wanted) {}

  void add(int change) {
    const std::lock_guard lock(mutex_);
    count_ += change;
    condition_.notify_all();
  }
  void wait_for_all() {
    std::unique_lock lock(mutex_);
    condition_.wait(lock, [&] { return count_ >= wanted_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable condition_;
  const int wanted_;
  int count_ = 0;
};

// A participant of the domain that ROS_DOMAIN_ID names.
inline fdds::DomainParticipant* create_participant() {
  const char* const domain = std::getenv("ROS_DOMAIN_ID");
  auto* factory = fdds::DomainParticipantFactory::get_instance();
  return factory->create_participant(static_cast<std::uint32_t>(domain == nullptr ? 0 : std::atoi(domain)),
                                     factory->get_default_participant_qos());
}

}  // namespace latency
