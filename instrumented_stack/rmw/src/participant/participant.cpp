// SPDX-License-Identifier: Apache-2.0
#include "participant/participant.hpp"

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "fastdds_versions/discovery_listener.hpp"
#include "fastdds_versions/profile_transports.hpp"
#include "fastdds_versions/transport.hpp"
#include "participant/default_transports.hpp"
#include "participant/discovery_range.hpp"
#include "participant/discovery_traffic.hpp"
#include "participant/profiles.hpp"
#include "participant/shared_memory_ports.hpp"
#include "participant/user_data.hpp"
#include "process/end_of_process.hpp"
#include "qos/qos.hpp"
#include "rcutils/logging.h"
#include "types/dds_gid.hpp"
#include "types/message_type.hpp"

namespace rmw_fastrtps {
namespace {

fdds::PublishModeQosPolicyKind publish_mode(fdds::PublishModeQosPolicyKind in_profile) {
  const char* value = std::getenv("RMW_FASTRTPS_PUBLICATION_MODE");
  const std::string_view mode = value == nullptr ? "" : value;
  if (mode == "ASYNCHRONOUS") {
    return fdds::ASYNCHRONOUS_PUBLISH_MODE;
  }
  if (mode == "AUTO") {
    return in_profile;
  }
  if (!mode.empty() && mode != "SYNCHRONOUS") {
    rcutils_log(
        nullptr, RCUTILS_LOG_SEVERITY_WARN, "rmw_fastrtps",
        "RMW_FASTRTPS_PUBLICATION_MODE is '%s', but must be SYNCHRONOUS, ASYNCHRONOUS or AUTO; using SYNCHRONOUS",
        value);
  }
  return fdds::SYNCHRONOUS_PUBLISH_MODE;
}

// The participants of this process. The lock is held while one of them is created.
struct Siblings {
  std::mutex mutex;
  std::vector<rtps::GuidPrefix_t> prefixes;
  std::uint16_t created = 0;
};

Siblings& siblings() {
  // Never destroyed, because a context may outlive the static objects of this library.
  static auto* siblings = new Siblings;
  return *siblings;
}

// Makes a further participant of the process look as if it belonged to another process on this host.
//
// Fast DDS compares the first eight bytes of two GUIDs: two of the vendor, two of the host, four of the process. If
// they are equal, it assumes that both participants are in one process and lets them write into each other's memory.
// Release 2.9 does so even after one is gone, until the other hears of its end (fixed later by its pull request 5034).
void be_no_neighbour_of(const rtps::GuidPrefix_t& first, std::uint16_t number, rtps::GuidPrefix_t& prefix) {
  prefix = first;
  const auto differ = [&](std::size_t byte) {
    prefix.value[byte] = static_cast<rtps::octet>(prefix.value[byte] ^ (number >> 8));
    prefix.value[byte + 1] = static_cast<rtps::octet>(prefix.value[byte + 1] ^ (number & 0xff));
  };
  constexpr std::size_t kRandomOfProcess = 6;
  constexpr std::size_t kParticipant = 8;
  differ(kRandomOfProcess);
  differ(kParticipant);
}

// The factory that is left at the end of the process. "used" makes the compiler store it though nothing reads it: the
// leak checker looks for it here.
[[gnu::used]] std::shared_ptr<fdds::DomainParticipantFactory>* left_factory = nullptr;

// The factory of Fast DDS waits 100 ms in its destructor, at the end of each process. The process ends without it.
class KeptFactory {
 public:
  ~KeptFactory() { left_factory = new std::shared_ptr(std::move(factory_)); }

 private:
  std::shared_ptr<fdds::DomainParticipantFactory> factory_ = fdds::DomainParticipantFactory::get_shared_instance();
};

// Creates a participant that others do not see yet. Returns null on errors.
fdds::DomainParticipant* create_disabled_participant(std::uint32_t domain_id, const fdds::DomainParticipantQos& qos,
                                                     fdds::DomainParticipantListener& listener) {
  static const KeptFactory kept;  // made after the factory, so destroyed before it
  auto* factory = fdds::DomainParticipantFactory::get_instance();
  fdds::DomainParticipantFactoryQos before;
  factory->get_qos(before);
  fdds::DomainParticipantFactoryQos disabled = before;
  disabled.entity_factory().autoenable_created_entities = false;
  factory->set_qos(disabled);
  auto* participant = factory->create_participant(domain_id, qos, &listener, fdds::StatusMask::none());
  factory->set_qos(before);
  return participant;
}

// Returns null on errors.
fdds::DomainParticipant* create_participant(std::uint32_t domain_id, fdds::DomainParticipantQos qos,
                                            bool may_choose_ports, fdds::DomainParticipantListener& listener) {
  auto* participant = create_disabled_participant(domain_id, qos, listener);
  if (participant == nullptr) {
    return nullptr;
  }
  if (may_choose_ports) {
    // Only a participant knows the host's identity.
    choose_shared_memory_ports(domain_id, participant->guid().guidPrefix, qos);
    participant->set_qos(qos);
  }
  if (participant->enable() != rmw_fastrtps::return_code::kOk) {
    fdds::DomainParticipantFactory::get_instance()->delete_participant(participant);
    return nullptr;
  }
  return participant;
}

}  // namespace

class Participant::DiscoveryListener final : public FoundListener {
 public:
  DiscoveryListener(GraphCache& graph, UnansweredParticipants& unanswered, DiscoveryTraffic& traffic)
      : graph_(graph), unanswered_(unanswered), traffic_(traffic) {}

  void participant_changed(const FoundParticipant& participant) override {
    const Gid gid = to_gid(participant.guid);
    switch (participant.change) {
      case FoundParticipant::Change::kFound:
        traffic_.discovered(participant.guid.guidPrefix, participant.locators,
                            std::chrono::nanoseconds(participant.lease.to_ns()));
        graph_.add_participant(gid, user_data_value(participant.user_data, "enclave"));
        unanswered_.discovered(gid, std::chrono::steady_clock::now());
        break;
      case FoundParticipant::Change::kGone:
        traffic_.gone(participant.guid.guidPrefix);
        graph_.remove_participant(gid);
        unanswered_.settled(gid);
        break;
      case FoundParticipant::Change::kOther:
        break;
    }
  }

  void endpoint_changed(const FoundEndpoint& endpoint) override {
    const Gid gid = to_gid(endpoint.guid);
    unanswered_.settled(gid);
    if (endpoint.is_removed) {
      graph_.remove_endpoint(gid);
      return;
    }
    const auto kind = endpoint.is_writer ? GraphCache::Kind::kWriter : GraphCache::Kind::kReader;
    graph_.add_endpoint(gid, {kind, endpoint.topic, endpoint.type, profile_of(endpoint), nullptr,
                              user_data_value(endpoint.user_data, "typehash")});
  }

 private:
  GraphCache& graph_;
  UnansweredParticipants& unanswered_;
  DiscoveryTraffic& traffic_;
};

Participant::Participant(const rmw_init_options_t& options, GraphCache& graph)
    : graph_(graph),
      traffic_(std::make_shared<DiscoveryTraffic>()),
      listener_(std::make_unique<DiscoveryListener>(graph, unanswered_, *traffic_)) {
  const char* from_xml = std::getenv("RMW_FASTRTPS_USE_QOS_FROM_XML");
  qos_from_xml_ = from_xml != nullptr && std::string_view(from_xml) == "1";

  auto* factory = fdds::DomainParticipantFactory::get_instance();
  load_profiles(*factory);
  fdds::DomainParticipantQos qos = factory->get_default_participant_qos();
  const auto domain_id =
      options.domain_id == RMW_DEFAULT_DOMAIN_ID ? 0u : static_cast<std::uint32_t>(options.domain_id);
  // A profile may have chosen other transports.
  const bool leaves_transports_to_us =
      qos.transport().use_builtin_transports && qos.transport().user_transports.empty();
  const auto wanted = leaves_transports_to_us ? wanted_builtin_transports() : std::nullopt;
  const bool may_choose_ports = wanted && wanted->udp4 && wanted->shared_memory;
  const bool leaves_buffers_to_us = wanted && (has_default_transports(qos) || wanted->are_of_environment);
  const char* discovery_server = std::getenv("ROS_DISCOVERY_SERVER");
  uses_discovery_server_ = discovery_server != nullptr && *discovery_server != '\0';
  configure_discovery(options.discovery_options, domain_id, wanted, traffic_, qos);
  if (leaves_buffers_to_us && qos.transport().user_transports.empty()) {
    use_default_transports(*wanted, 0, traffic_, qos);
  } else if (!leaves_buffers_to_us) {
    forward_shared_memory(qos);
  }
  warn_of_another_user(domain_id, qos);
  const std::string enclave = options.enclave == nullptr ? "/" : options.enclave;
  qos.user_data().data_vec(enclave_user_data(enclave));
  qos.name(enclave);
  if (!qos_from_xml_) {
    // The announcements of many endpoints exceed the initial size.
    qos.wire_protocol().builtin.readerHistoryMemoryPolicy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.wire_protocol().builtin.writerHistoryMemoryPolicy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  }

  if (uses_discovery_server_ || !leaves_buffers_to_us) {
    traffic_->introduce({});  // announced at once, as Fast DDS does
  }
  {
    std::lock_guard lock(siblings().mutex);
    if (!siblings().prefixes.empty()) {
      be_no_neighbour_of(siblings().prefixes.front(), ++siblings().created, qos.wire_protocol().prefix);
    }
    const bool is_on_udp_alone = qos.transport().user_transports.size() == 1;
    participant_ = create_participant(domain_id, qos, may_choose_ports && !is_on_udp_alone, *listener_);
    if (participant_ == nullptr) {
      throw std::runtime_error("Fast DDS cannot create a participant in domain " + std::to_string(domain_id) +
                               ", see its own messages above");
    }
    publisher_ = participant_->create_publisher(participant_->get_default_publisher_qos());
    subscriber_ = participant_->create_subscriber(participant_->get_default_subscriber_qos());
    gid_ = to_gid(participant_->guid());
    graph.add_participant(gid_, enclave);
    siblings().prefixes.push_back(participant_->guid().guidPrefix);
  }
  ended_with_process_.emplace([this] { end(); });
  prepare_end_of_process();
}

Participant::~Participant() {
  ended_with_process_.reset();
  if (participant_ != nullptr) {
    end();
  }
}

void Participant::end() {
  const rtps::GuidPrefix_t prefix = participant_->guid().guidPrefix;
  // No callback may run while, or after, the participant is taken apart.
  participant_->set_listener(nullptr);
  participant_->delete_contained_entities();
  fdds::DomainParticipantFactory::get_instance()->delete_participant(std::exchange(participant_, nullptr));
  std::lock_guard lock(siblings().mutex);
  std::erase(siblings().prefixes, prefix);
}

void Participant::introduce() {
  if (!traffic_->is_introduced()) {
    traffic_->introduce(participant_->guid().guidPrefix);
    announce();
  }
}

void Participant::end_endpoints_silently() {
  traffic_->end_endpoints_silently();
}

void Participant::announce_again(const std::vector<Gid>& participants) {
  if (uses_discovery_server_) {
    return;  // the server tells of us, and Fast DDS 2.9 would complain that the QoS names no server
  }
  std::vector<rtps::GuidPrefix_t> prefixes;
  for (const Gid& gid : participants) {
    prefixes.push_back(to_guid(gid).guidPrefix);
  }
  const DiscoveryTraffic::OnlyTo only(*traffic_, prefixes);
  announce();
}

void Participant::announce() {
  // Fast DDS announces changes at once. The user data mean the same with and without the terminating null.
  fdds::DomainParticipantQos qos = participant_->get_qos();
  std::vector<rtps::octet> user_data = qos.user_data().data_vec();
  if (!user_data.empty() && user_data.back() == '\0') {
    user_data.pop_back();
  } else {
    user_data.push_back('\0');
  }
  qos.user_data().data_vec(user_data);
  participant_->set_qos(qos);
}

fdds::Topic& Participant::acquire_topic(const std::string& dds_name,
                                        const message_type_support_callbacks_t& callbacks) {
  if (process_ends()) {
    throw std::runtime_error("nothing can be created at the end of the process");
  }
  const std::string type_name = dds_type_name(callbacks);
  if (const auto found = topics_.find(dds_name); found != topics_.end()) {
    if (found->second.topic->get_type_name() != type_name) {
      throw std::runtime_error("topic '" + dds_name + "' is in use with type '" + found->second.topic->get_type_name() +
                               "' and cannot have type '" + type_name + "' as well");
    }
    ++found->second.users;
    return *found->second.topic;
  }
  if (participant_->find_type(type_name).empty()) {
    fdds::TypeSupport type(new MessageType(callbacks));
    if (type.register_type(participant_) != rmw_fastrtps::return_code::kOk) {
      throw std::runtime_error("Fast DDS cannot register type '" + type_name + "'");
    }
  }
  fdds::Topic* topic = participant_->create_topic(dds_name, type_name, participant_->get_default_topic_qos());
  if (topic == nullptr) {
    throw std::runtime_error("Fast DDS cannot create topic '" + dds_name + "' with type '" + type_name + "'");
  }
  topics_.emplace(dds_name, SharedTopic{topic, 1});
  ++topics_of_type_[type_name];
  return *topic;
}

void Participant::delete_writer(fdds::DataWriter& writer) {
  if (process_ends()) {
    return;
  }
  writer.set_listener(nullptr);
  publisher_->delete_datawriter(&writer);
}

void Participant::delete_reader(fdds::DataReader& reader) {
  if (process_ends()) {
    return;
  }
  reader.set_listener(nullptr);
  subscriber_->delete_datareader(&reader);
}

void Participant::release_topic(fdds::Topic& topic) {
  if (process_ends()) {
    return;
  }
  const auto found = topics_.find(topic.get_name());
  if (--found->second.users != 0) {
    return;
  }
  const std::string type_name = topic.get_type_name();
  topics_.erase(found);
  participant_->delete_topic(&topic);
  // The library with the type support may be unloaded after the last topic of the type. Fast DDS refuses to unregister
  // a type that a topic uses, but it goes through all endpoints to find out. So count the topics here.
  const auto topics = topics_of_type_.find(type_name);
  if (--topics->second == 0) {
    topics_of_type_.erase(topics);
    participant_->unregister_type(type_name);
  }
}

fdds::DataWriterQos Participant::writer_qos(const std::string& topic_name,
                                            const message_type_support_callbacks_t& type) const {
  fdds::DataWriterQos qos = publisher_->get_default_datawriter_qos();
  publisher_->get_datawriter_qos_from_profile(topic_name, qos);
  if (!qos_from_xml_) {
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
    qos.publish_mode().kind = publish_mode(qos.publish_mode().kind);
  }
  qos.user_data().data_vec(type_hash_user_data(type.type_hash_));
  return qos;
}

fdds::DataReaderQos Participant::reader_qos(const std::string& topic_name,
                                            const message_type_support_callbacks_t& type) const {
  fdds::DataReaderQos qos = subscriber_->get_default_datareader_qos();
  subscriber_->get_datareader_qos_from_profile(topic_name, qos);
  if (!qos_from_xml_) {
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
  }
  qos.user_data().data_vec(type_hash_user_data(type.type_hash_));
  return qos;
}

}  // namespace rmw_fastrtps
