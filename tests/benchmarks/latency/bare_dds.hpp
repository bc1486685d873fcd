// SPDX-License-Identifier: Apache-2.0
// What the floors on bare Fast DDS share: messages, and the quality of service that the stack's rmw asks for.
#pragma once

#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <mutex>
#include <string>

#include "fastcdr_versions/cdr.hpp"
#include "fastdds_versions/topic_type.hpp"
#include "worker.hpp"

namespace latency {

namespace fdds = eprosima::fastdds::dds;
namespace rtps = rmw_fastrtps::rtps;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

// Any of the message types; the size decides the length of `data`.
struct Message {
  std::int64_t sent;
  std::int64_t remaining;
  std::uint8_t data[kSizes.back() - 2 * sizeof(std::int64_t)];
};

// A type whose messages have `size` bytes.
class MessageType final : public rmw_fastrtps::TopicTypeOf<MessageType> {
 public:
  explicit MessageType(std::size_t size)
      : TopicTypeOf("Bytes" + std::to_string(size), static_cast<std::uint32_t>(size) + kEncapsulation),
        length_(size - 2 * sizeof(std::int64_t)) {}

  bool write(const void* data, rtps::SerializedPayload_t& payload) const {
    const Message& message = *static_cast<const Message*>(data);
    FastBuffer buffer(reinterpret_cast<char*>(payload.data), payload.max_size);
    Cdr cdr = fastcdr_versions::plain_cdr(buffer);
    payload.encapsulation = CDR_LE;
    cdr.serialize_encapsulation();
    cdr << message.sent << message.remaining;
    fastcdr_versions::write_array(cdr, message.data, length_);
    payload.length = static_cast<std::uint32_t>(fastcdr_versions::written_size(cdr));
    return true;
  }
  bool read(const rtps::SerializedPayload_t& payload, void* data) const {
    Message& message = *static_cast<Message*>(data);
    FastBuffer buffer(reinterpret_cast<char*>(payload.data), payload.length);
    Cdr cdr = fastcdr_versions::plain_cdr(buffer);
    cdr.read_encapsulation();
    cdr >> message.sent >> message.remaining;
    fastcdr_versions::read_array(cdr, message.data, length_);
    return true;
  }
  std::uint32_t size_of(const void*) const {
    return kEncapsulation + 2 * sizeof(std::int64_t) + static_cast<std::uint32_t>(length_);
  }
  void* create() { return new Message; }
  void destroy(void* data) { delete static_cast<Message*>(data); }
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
