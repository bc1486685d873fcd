// SPDX-License-Identifier: Apache-2.0
#include "participant/default_transports.hpp"

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/TransportInterface.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <sys/statvfs.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "rcutils/logging.h"

namespace rmw_fastrtps {
namespace {

namespace fdds = eprosima::fastdds::dds;
namespace transport = eprosima::fastdds::rtps;
namespace rtps = eprosima::fastrtps::rtps;

// Its segment of 512 KiB, and its ports.
constexpr std::uint64_t kMemoryOfParticipant = 1024 * 1024;

using transport::Locator;
using transport::LocatorList;

// What a transport tells Fast DDS about itself.
struct ReportedConfiguration : transport::TransportDescriptorInterface {
  explicit ReportedConfiguration(const transport::TransportDescriptorInterface& of_transport)
      : TransportDescriptorInterface(of_transport.max_message_size(), of_transport.max_initial_peers_range()) {}

  transport::TransportInterface* create_transport() const override { return nullptr; }
  std::uint32_t min_send_buffer_size() const override { return kBytesBetweenHeartbeats; }
};

// Lets what `traffic` allows pass to the transport behind a sender.
struct FilteredSender : rtps::SenderResource {
  static void filter(rtps::SenderResource& sender, const std::shared_ptr<DiscoveryTraffic>& traffic) {
    auto& send = sender.*&FilteredSender::send_lambda_;
    send = [send, traffic](const rtps::octet* data, std::uint32_t size, transport::LocatorsIterator* begin,
                           transport::LocatorsIterator* end, const std::chrono::steady_clock::time_point& deadline) {
      if (!traffic->is_introduced()) {
        return true;
      }
      const auto message = discovery_message_in({data, size});
      if (!message) {
        return send(data, size, begin, end, deadline);
      }
      std::vector<Locator> destinations;
      for (; *begin != *end; ++*begin) {
        destinations.push_back(**begin);
      }
      traffic->restrict(*message, destinations, std::chrono::steady_clock::now());
      transport::Locators first(destinations.begin());
      transport::Locators last(destinations.end());
      return destinations.empty() || send(data, size, &first, &last, deadline);
    };
  }
};

// Hands over what `traffic` lets hear.
class FilteredReceiver final : public transport::TransportReceiverInterface {
 public:
  FilteredReceiver(transport::TransportReceiverInterface& receiver, std::shared_ptr<DiscoveryTraffic> traffic)
      : receiver_(receiver), traffic_(std::move(traffic)) {}

  void OnDataReceived(const rtps::octet* data, std::uint32_t size, const Locator& local,
                      const Locator& remote) override {
    if (!traffic_->is_introduced()) {
      return;
    }
    const auto message = discovery_message_in({data, size});
    if (!message || traffic_->is_heard(*message, local.kind, std::chrono::steady_clock::now())) {
      receiver_.OnDataReceived(data, size, local, remote);
    }
  }

 private:
  transport::TransportReceiverInterface& receiver_;
  const std::shared_ptr<DiscoveryTraffic> traffic_;
};

// Hands everything over to `inner`, except for its configuration. Messages pass by `traffic`.
class FilteredTransport final : public transport::TransportInterface {
 public:
  FilteredTransport(std::unique_ptr<TransportInterface> inner, std::shared_ptr<DiscoveryTraffic> traffic)
      : TransportInterface(inner->kind()), traffic_(std::move(traffic)), inner_(std::move(inner)) {}

  bool init(const rtps::PropertyPolicy* properties) override {
    if (!inner_->init(properties)) {
      return false;
    }
    configuration_.emplace(*inner_->get_configuration());
    return true;
  }
  transport::TransportDescriptorInterface* get_configuration() override { return &*configuration_; }

  bool IsInputChannelOpen(const Locator& locator) const override { return inner_->IsInputChannelOpen(locator); }
  bool IsLocatorSupported(const Locator& locator) const override { return inner_->IsLocatorSupported(locator); }
  bool is_locator_allowed(const Locator& locator) const override { return inner_->is_locator_allowed(locator); }
  Locator RemoteToMainLocal(const Locator& remote) const override { return inner_->RemoteToMainLocal(remote); }
  bool transform_remote_locator(const Locator& remote, Locator& result) const override {
    return inner_->transform_remote_locator(remote, result);
  }
  // Fast DDS asks for the channels to all known participants whenever it finds one more.
  bool OpenOutputChannel(transport::SendResourceList& senders, const Locator& locator) override {
    if (interfaces_changed_.exchange(false)) {
      open_.clear();
    }
    if (open_.count(locator) != 0) {
      return true;
    }
    const std::size_t before = senders.size();
    if (!inner_->OpenOutputChannel(senders, locator)) {
      return false;
    }
    for (std::size_t i = before; i < senders.size(); ++i) {
      FilteredSender::filter(*senders[i], traffic_);
    }
    open_.insert(locator);
    return true;
  }
  bool OpenInputChannel(const Locator& locator, transport::TransportReceiverInterface* receiver,
                        std::uint32_t max_message_size) override {
    receivers_.push_back(std::make_unique<FilteredReceiver>(*receiver, traffic_));
    return inner_->OpenInputChannel(locator, receivers_.back().get(), max_message_size);
  }
  bool CloseInputChannel(const Locator& locator) override { return inner_->CloseInputChannel(locator); }
  bool DoInputLocatorsMatch(const Locator& left, const Locator& right) const override {
    return inner_->DoInputLocatorsMatch(left, right);
  }
  LocatorList NormalizeLocator(const Locator& locator) override { return inner_->NormalizeLocator(locator); }
  void select_locators(rtps::LocatorSelector& selector) const override { inner_->select_locators(selector); }
  bool is_local_locator(const Locator& locator) const override { return inner_->is_local_locator(locator); }
  void AddDefaultOutputLocator(LocatorList& list) override { inner_->AddDefaultOutputLocator(list); }
  bool getDefaultMetatrafficMulticastLocators(LocatorList& locators, std::uint32_t port) const override {
    return inner_->getDefaultMetatrafficMulticastLocators(locators, port);
  }
  bool getDefaultMetatrafficUnicastLocators(LocatorList& locators, std::uint32_t port) const override {
    return inner_->getDefaultMetatrafficUnicastLocators(locators, port);
  }
  bool getDefaultUnicastLocators(LocatorList& locators, std::uint32_t port) const override {
    return inner_->getDefaultUnicastLocators(locators, port);
  }
  bool fillMetatrafficMulticastLocator(Locator& locator, std::uint32_t port) const override {
    return inner_->fillMetatrafficMulticastLocator(locator, port);
  }
  bool fillMetatrafficUnicastLocator(Locator& locator, std::uint32_t port) const override {
    return inner_->fillMetatrafficUnicastLocator(locator, port);
  }
  bool configureInitialPeerLocator(Locator& locator, const rtps::PortParameters& ports, std::uint32_t domain_id,
                                   LocatorList& list) const override {
    return inner_->configureInitialPeerLocator(locator, ports, domain_id, list);
  }
  bool fillUnicastLocator(Locator& locator, std::uint32_t port) const override {
    return inner_->fillUnicastLocator(locator, port);
  }
  std::uint32_t max_recv_buffer_size() const override { return inner_->max_recv_buffer_size(); }
  void shutdown() override { inner_->shutdown(); }
  void update_network_interfaces() override {
    inner_->update_network_interfaces();
    interfaces_changed_ = true;
  }

 private:
  const std::shared_ptr<DiscoveryTraffic> traffic_;
  std::vector<std::unique_ptr<FilteredReceiver>> receivers_;  // outlive the threads of `inner_`
  std::unique_ptr<TransportInterface> inner_;
  std::optional<ReportedConfiguration> configuration_;
  std::set<Locator> open_;  // Fast DDS opens one at a time
  std::atomic<bool> interfaces_changed_{false};
};

// Stays a descriptor of its kind, because Fast DDS looks for the one of shared memory.
template <typename Descriptor>
struct Filtered final : Descriptor {
  explicit Filtered(std::shared_ptr<DiscoveryTraffic> of_participant) : traffic(std::move(of_participant)) {}

  transport::TransportInterface* create_transport() const override {
    return new FilteredTransport(std::unique_ptr<transport::TransportInterface>(Descriptor::create_transport()),
                                 traffic);
  }

  std::shared_ptr<DiscoveryTraffic> traffic;
};

}  // namespace

bool has_room_in_shared_memory(std::uint64_t bytes) {
  struct statvfs room {};
  // A file system without a limit has no number of blocks.
  return statvfs("/dev/shm", &room) != 0 || room.f_blocks == 0 || room.f_bavail * room.f_frsize >= bytes;
}

bool has_default_transports(const fdds::DomainParticipantQos& qos) {
  const auto& transports = qos.transport();
  return transports.use_builtin_transports && transports.user_transports.empty() &&
         transports.send_socket_buffer_size == 0 && transports.listen_socket_buffer_size == 0;
}

void use_default_transports(std::uint32_t local_peers, const std::shared_ptr<DiscoveryTraffic>& traffic,
                            fdds::DomainParticipantQos& qos) {
  auto udp = std::make_shared<Filtered<transport::UDPv4TransportDescriptor>>(traffic);
  if (local_peers != 0) {
    udp->maxInitialPeersRange = local_peers;
  }
  auto shared_memory = std::make_shared<Filtered<transport::SharedMemTransportDescriptor>>(traffic);
  shared_memory->max_message_size(udp->max_message_size());
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = {udp};
  if (has_room_in_shared_memory(kMemoryOfParticipant)) {
    qos.transport().user_transports.push_back(shared_memory);
  } else {
    rcutils_log(nullptr, RCUTILS_LOG_SEVERITY_WARN, "rmw_fastrtps",
                "/dev/shm is full: messages to processes of this host take the way over UDP");
  }
}

}  // namespace rmw_fastrtps
