// SPDX-License-Identifier: Apache-2.0
// The DDS participant of a context, with its topics. It passes on what discovery reports.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "graph/graph_cache.hpp"
#include "participant/unanswered_participants.hpp"
#include "process/end_of_process.hpp"
#include "rmw/init_options.h"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"
#include "types/gid.hpp"

namespace eprosima::fastdds::dds {
class DataReader;
class DataReaderQos;
class DataWriter;
class DataWriterQos;
class DomainParticipant;
class Publisher;
class Subscriber;
class Topic;
}  // namespace eprosima::fastdds::dds

namespace rmw_fastrtps {

class DiscoveryTraffic;

// Constructor and functions throw std::runtime_error. Not thread safe; delete every endpoint before.
//
// Environment, as in rmw_fastrtps_cpp: FASTRTPS_DEFAULT_PROFILES_FILE, or FASTDDS_DEFAULT_PROFILES_FILE, names a file
// of XML profiles. Its default profiles and those named like a topic apply. With RMW_FASTRTPS_USE_QOS_FROM_XML=1 they
// also decide memory, data sharing and publish mode. RMW_FASTRTPS_PUBLICATION_MODE is SYNCHRONOUS (default),
// ASYNCHRONOUS or AUTO (as in the profile).
class Participant {
 public:
  // Reports what it discovers to `graph`, which must outlive the participant.
  Participant(const rmw_init_options_t& options, GraphCache& graph);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  // The participants that may not know this one yet; says when announce_again() is due.
  UnansweredParticipants& unanswered() { return unanswered_; }
  // From now on others hear of this participant, and it hears of them. It has been silent so that others learn of its
  // first endpoints at once, which costs a fraction of telling them one by one.
  void introduce();
  // From now on others are not told of each endpoint that ends, only of the end of the participant.
  void end_endpoints_silently();
  // Announces this participant to these once more. Must not be called from a listener of Fast DDS.
  void announce_again(const std::vector<Gid>& participants);

  const Gid& gid() const { return gid_; }
  GraphCache& graph() { return graph_; }
  eprosima::fastdds::dds::Publisher& publisher() { return *publisher_; }
  eprosima::fastdds::dds::Subscriber& subscriber() { return *subscriber_; }

  // All endpoints on a topic share it. Release it as often as you acquired it.
  eprosima::fastdds::dds::Topic& acquire_topic(const std::string& dds_name,
                                               const message_type_support_callbacks_t& callbacks);
  void release_topic(eprosima::fastdds::dds::Topic& topic);
  // The listener is told of nothing any more.
  void delete_writer(eprosima::fastdds::dds::DataWriter& writer);
  void delete_reader(eprosima::fastdds::dds::DataReader& reader);

  // The QoS for creating an endpoint, before the ROS profile is applied.
  eprosima::fastdds::dds::DataWriterQos writer_qos(const std::string& topic_name,
                                                   const message_type_support_callbacks_t& type) const;
  eprosima::fastdds::dds::DataReaderQos reader_qos(const std::string& topic_name,
                                                   const message_type_support_callbacks_t& type) const;

 private:
  class DiscoveryListener;

  void announce();
  void end();

  struct SharedTopic {
    eprosima::fastdds::dds::Topic* topic;
    std::size_t users;
  };

  GraphCache& graph_;
  UnansweredParticipants unanswered_;
  std::shared_ptr<DiscoveryTraffic> traffic_;
  std::unique_ptr<DiscoveryListener> listener_;
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
  std::map<std::string, SharedTopic> topics_;
  std::map<std::string, std::size_t> topics_of_type_;
  Gid gid_{};
  bool qos_from_xml_ = false;
  bool uses_discovery_server_ = false;
  std::optional<EndedWithProcess> ended_with_process_;
};

}  // namespace rmw_fastrtps
