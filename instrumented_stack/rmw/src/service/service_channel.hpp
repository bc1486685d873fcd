// SPDX-License-Identifier: Apache-2.0
// The two topics of a service as one end sees them: a reader for incoming messages, a writer for outgoing ones.
#pragma once

#include <chrono>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <string>

#include "endpoint/endpoint.hpp"
#include "rmw/types.h"
#include "rosidl_runtime_c/service_type_support_struct.h"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"
#include "wait/data_reader_waitable.hpp"

namespace rmw_fastrtps {

class Participant;

// Services and clients derive from it to react to matched endpoints. Listeners are called between open() and close().
// That is why constructor and destructor do not open and close.
class ServiceChannel : public DataReaderWaitable, public eprosima::fastdds::dds::DataWriterListener {
 public:
  enum class End { kService, kClient };

  // Also enters the two endpoints into the graph of the node. The caller holds the lock of the node's context. Throws
  // std::runtime_error, and is then closed.
  void open(End end, const rmw_node_t* node, const rosidl_service_type_support_t& type_support,
            const std::string& service_name, const rmw_qos_profile_t& profile);
  void close(const rmw_node_t* node);

  // At its end a channel waits at most so long for the other ends. It needs all of it only if one is stopped or gone.
  static constexpr std::chrono::nanoseconds kPatienceAtEnd = std::chrono::milliseconds(500);

  // Waits until the other ends have got all that was sent. Fast DDS tells the end of an endpoint on another port than
  // its messages. If the end is read first, it drops the messages. Call it before close(), without the lock.
  void wait_until_received() const;

  const std::string& service_name() const { return service_name_; }
  Participant& participant() { return *participant_; }
  const Gid& reader_gid() const { return reader_identity_.gid; }

  rmw_ret_t get_reader_qos(rmw_qos_profile_t* qos) const;
  rmw_ret_t get_writer_qos(rmw_qos_profile_t* qos) const;

  eprosima::fastdds::dds::DataWriter* writer = nullptr;
  const message_type_support_callbacks_t* reader_type = nullptr;
  const message_type_support_callbacks_t* writer_type = nullptr;

 private:
  void open_endpoints(End end, const rosidl_service_type_support_t& type_support, const rmw_qos_profile_t& profile);
  void close_endpoints();
  void open_reader(const std::string& topic_name, const message_type_support_callbacks_t& type,
                   const rmw_qos_profile_t& profile);
  void open_writer(const std::string& topic_name, const message_type_support_callbacks_t& type,
                   const rmw_qos_profile_t& profile);

  std::string service_name_;
  Participant* participant_ = nullptr;
  eprosima::fastdds::dds::Topic* reader_topic_ = nullptr;
  eprosima::fastdds::dds::Topic* writer_topic_ = nullptr;
  EndpointIdentity reader_identity_{};
  EndpointIdentity writer_identity_{};
};

}  // namespace rmw_fastrtps
