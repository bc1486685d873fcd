// SPDX-License-Identifier: Apache-2.0
// What discovery tells of other participants and their endpoints.
#pragma once

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <string>
#include <vector>

#include "fastdds_versions/guid.hpp"

#if RMW_FASTDDS_MAJOR < 3
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#endif

namespace rmw_fastrtps {

struct FoundParticipant {
  enum class Change { kFound, kOther, kGone };

  Change change;
  rtps::GUID_t guid;
  std::string name;
  const std::vector<rtps::octet>& user_data;
  std::vector<rtps::Locator_t> locators;  // unicast, for discovery
  DdsDuration lease;
};

struct FoundEndpoint {
  bool is_writer;
  bool is_removed;
  rtps::GUID_t guid;
  std::string topic;
  std::string type;
  const std::vector<rtps::octet>& user_data;
  const fdds::ReliabilityQosPolicy& reliability;
  const fdds::DurabilityQosPolicy& durability;
  const fdds::LivelinessQosPolicy& liveliness;
  const fdds::DeadlineQosPolicy& deadline;
  const fdds::LifespanQosPolicy* lifespan;  // null for a reader
};

// Called by threads of Fast DDS.
class FoundListener : public fdds::DomainParticipantListener {
 protected:
  virtual void participant_changed(const FoundParticipant& participant) = 0;
  virtual void endpoint_changed(const FoundEndpoint& endpoint) = 0;

#if RMW_FASTDDS_MAJOR >= 3
 private:
  void on_participant_discovery(fdds::DomainParticipant*, rtps::ParticipantDiscoveryStatus reason,
                                const fdds::ParticipantBuiltinTopicData& info, bool&) override {
    using Status = rtps::ParticipantDiscoveryStatus;
    const auto& locators = info.metatraffic_locators.unicast;
    participant_changed({reason == Status::DISCOVERED_PARTICIPANT ? FoundParticipant::Change::kFound
                         : reason == Status::REMOVED_PARTICIPANT || reason == Status::DROPPED_PARTICIPANT
                             ? FoundParticipant::Change::kGone
                             : FoundParticipant::Change::kOther,
                         info.guid,
                         info.participant_name.to_string(),
                         info.user_data.data_vec(),
                         {locators.begin(), locators.end()},
                         info.lease_duration});
  }
  void on_data_writer_discovery(fdds::DomainParticipant*, rtps::WriterDiscoveryStatus reason,
                                const fdds::PublicationBuiltinTopicData& info, bool&) override {
    tell(true, reason == rtps::WriterDiscoveryStatus::REMOVED_WRITER, info, &info.lifespan);
  }
  void on_data_reader_discovery(fdds::DomainParticipant*, rtps::ReaderDiscoveryStatus reason,
                                const fdds::SubscriptionBuiltinTopicData& info, bool&) override {
    tell(false, reason == rtps::ReaderDiscoveryStatus::REMOVED_READER, info, nullptr);
  }

  template <typename Data>
  void tell(bool is_writer, bool is_removed, const Data& data, const fdds::LifespanQosPolicy* lifespan) {
    endpoint_changed({is_writer, is_removed, data.guid, data.topic_name.to_string(), data.type_name.to_string(),
                      data.user_data.data_vec(), data.reliability, data.durability, data.liveliness, data.deadline,
                      lifespan});
  }
#else
 private:
  using DomainParticipantListener::on_participant_discovery;
  using DomainParticipantListener::on_publisher_discovery;
  using DomainParticipantListener::on_subscriber_discovery;
  void on_participant_discovery(fdds::DomainParticipant*, rtps::ParticipantDiscoveryInfo&& told) override {
    using Status = rtps::ParticipantDiscoveryInfo;
    const auto& locators = told.info.metatraffic_locators.unicast;
    participant_changed({told.status == Status::DISCOVERED_PARTICIPANT ? FoundParticipant::Change::kFound
                         : told.status == Status::REMOVED_PARTICIPANT || told.status == Status::DROPPED_PARTICIPANT
                             ? FoundParticipant::Change::kGone
                             : FoundParticipant::Change::kOther,
                         told.info.m_guid,
                         told.info.m_participantName.to_string(),
                         told.info.m_userData.data_vec(),
                         {locators.begin(), locators.end()},
                         told.info.m_leaseDuration});
  }
  void on_publisher_discovery(fdds::DomainParticipant*, rtps::WriterDiscoveryInfo&& told) override {
    tell(true, told.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER, told.info, &told.info.m_qos.m_lifespan);
  }
  void on_subscriber_discovery(fdds::DomainParticipant*, rtps::ReaderDiscoveryInfo&& told) override {
    tell(false, told.status == rtps::ReaderDiscoveryInfo::REMOVED_READER, told.info, nullptr);
  }

  template <typename Proxy>
  void tell(bool is_writer, bool is_removed, const Proxy& proxy, const fdds::LifespanQosPolicy* lifespan) {
    const auto& qos = proxy.m_qos;
    endpoint_changed({is_writer, is_removed, proxy.guid(), proxy.topicName().to_string(), proxy.typeName().to_string(),
                      qos.m_userData.data_vec(), qos.m_reliability, qos.m_durability, qos.m_liveliness, qos.m_deadline,
                      lifespan});
  }
#endif
};

}  // namespace rmw_fastrtps
