// SPDX-License-Identifier: Apache-2.0
#include "participant/default_transports.hpp"

#include <fastdds/rtps/transport/TransportInterface.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>

#include <memory>
#include <optional>

namespace rmw_fastrtps {
namespace {

namespace fdds = eprosima::fastdds::dds;
namespace transport = eprosima::fastdds::rtps;
namespace rtps = eprosima::fastrtps::rtps;

using transport::Locator;
using transport::LocatorList;

// What a transport tells Fast DDS about itself.
struct ReportedConfiguration : transport::TransportDescriptorInterface {
  explicit ReportedConfiguration(const transport::TransportDescriptorInterface& of_transport)
      : TransportDescriptorInterface(of_transport.max_message_size(), of_transport.max_initial_peers_range()) {}

  transport::TransportInterface* create_transport() const override { return nullptr; }
  std::uint32_t min_send_buffer_size() const override { return kBytesBetweenHeartbeats; }
};

// Hands everything over to `inner`, except for its configuration. Messages do not pass through here: `inner` opens the
// channels, and they belong to `inner`.
class ReportingTransport final : public transport::TransportInterface {
 public:
  explicit ReportingTransport(std::unique_ptr<TransportInterface> inner)
      : TransportInterface(inner->kind()), inner_(std::move(inner)) {}

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
  bool OpenOutputChannel(transport::SendResourceList& senders, const Locator& locator) override {
    return inner_->OpenOutputChannel(senders, locator);
  }
  bool OpenInputChannel(const Locator& locator, transport::TransportReceiverInterface* receiver,
                        std::uint32_t max_message_size) override {
    return inner_->OpenInputChannel(locator, receiver, max_message_size);
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
  void update_network_interfaces() override { inner_->update_network_interfaces(); }

 private:
  std::unique_ptr<TransportInterface> inner_;
  std::optional<ReportedConfiguration> configuration_;
};

// Stays a descriptor of its kind, because Fast DDS looks for the one of shared memory.
template <typename Descriptor>
struct Reporting final : Descriptor {
  transport::TransportInterface* create_transport() const override {
    return new ReportingTransport(std::unique_ptr<transport::TransportInterface>(Descriptor::create_transport()));
  }
};

}  // namespace

bool has_default_transports(const fdds::DomainParticipantQos& qos) {
  const auto& transports = qos.transport();
  return transports.use_builtin_transports && transports.user_transports.empty() &&
         transports.send_socket_buffer_size == 0 && transports.listen_socket_buffer_size == 0;
}

void use_default_transports(std::uint32_t local_peers, fdds::DomainParticipantQos& qos) {
  auto udp = std::make_shared<Reporting<transport::UDPv4TransportDescriptor>>();
  if (local_peers != 0) {
    udp->maxInitialPeersRange = local_peers;
  }
  auto shared_memory = std::make_shared<Reporting<transport::SharedMemTransportDescriptor>>();
  shared_memory->max_message_size(udp->max_message_size());
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = {udp, shared_memory};
}

}  // namespace rmw_fastrtps
