// SPDX-License-Identifier: Apache-2.0
#include "faults/publish_faults.hpp"

#include <utility>

#include "fastdds_versions/writer.hpp"
#include "faults/delayed_calls.hpp"
#include "types/message_type.hpp"

namespace rmw_fastrtps {

PublishFaults::~PublishFaults() {
  delayed_calls().forget(this);
}

bool PublishFaults::write(OutgoingMessage& message, rtps::WriteParams& params) {
  const MessageFate fate = faults_->next();
  if (fate.is_usual()) {
    return write_sample(writer_, &message, params);
  }
  if (fate.is_dropped) {
    return true;
  }
  std::vector<std::uint8_t> bytes = to_bytes(type_, message);
  if (bytes.empty()) {
    return false;
  }
  for (const std::uint64_t seed : fate.corruptions) {
    corrupt(bytes.data(), bytes.size(), seed);
  }
  bool is_written = true;
  const auto due = DelayedCalls::Clock::now() + fate.delay;
  for (unsigned copy = 0; copy < fate.copies; ++copy) {
    if (fate.delay.count() != 0) {
      // The time of publication stays, so the delay shows in what measures the age of messages.
      delayed_calls().add(this, due, [this, bytes, params]() mutable { write(bytes, params); });
    } else {
      is_written = write(bytes, params) && is_written;
    }
  }
  return is_written;
}

bool PublishFaults::write(std::vector<std::uint8_t>& bytes, rtps::WriteParams params) {
  rmw_serialized_message_t serialized = rmw_get_zero_initialized_serialized_message();
  serialized.buffer = bytes.data();
  serialized.buffer_length = serialized.buffer_capacity = bytes.size();
  OutgoingMessage message{nullptr, &serialized, nullptr};
  return write_sample(writer_, &message, params);
}

}  // namespace rmw_fastrtps
