// SPDX-License-Identifier: Apache-2.0
// Sends the messages of a publisher, or the responses of a service, as its faults want it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fastdds_versions/guid.hpp"
#include "faults/message_faults.hpp"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"

namespace eprosima::fastdds::dds {
class DataWriter;
}  // namespace eprosima::fastdds::dds

namespace rmw_fastrtps {

struct OutgoingMessage;

class PublishFaults {
 public:
  // The writer must outlive this object.
  PublishFaults(std::unique_ptr<MessageFaults> faults, eprosima::fastdds::dds::DataWriter& writer,
                const message_type_support_callbacks_t& type)
      : faults_(std::move(faults)), writer_(writer), type_(type) {}
  // Messages that are late are lost.
  ~PublishFaults();
  PublishFaults(const PublishFaults&) = delete;
  PublishFaults& operator=(const PublishFaults&) = delete;

  // False if the message could not be written. A message that is dropped, or that is sent later, counts as written.
  bool write(OutgoingMessage& message, rtps::WriteParams& params);

 private:
  bool write(std::vector<std::uint8_t>& bytes, rtps::WriteParams params);

  std::unique_ptr<MessageFaults> faults_;
  eprosima::fastdds::dds::DataWriter& writer_;
  const message_type_support_callbacks_t& type_;
};

}  // namespace rmw_fastrtps
