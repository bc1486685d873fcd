// SPDX-License-Identifier: Apache-2.0
// Transports that hand everything over to another one. Releases of Fast DDS differ in the functions of a transport and
// in how a sender gets its bytes.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fastdds_versions/guid.hpp"

#if RMW_FASTDDS_MAJOR >= 3
#include <fastdds/rtps/transport/NetworkBuffer.hpp>
#include <fastdds/rtps/transport/SenderResource.hpp>
#include <fastdds/rtps/transport/TransportInterface.hpp>
#include <fastdds/rtps/transport/TransportReceiverInterface.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/rtps/transport/UDPv6TransportDescriptor.hpp>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.hpp>
#else
#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/TransportInterface.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/UDPv6TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#endif

namespace rmw_fastrtps {

// Decides what becomes of the messages of a sender. `interception` is called with
//   bytes       those at the beginning of the message: more than the headers of its first submessages, perhaps not all
//   size        that of the whole message
//   begin, end  its destinations
//   send        sends the message to the destinations between two iterators, by another sender if it is given one;
//               false: it could not be sent
// and returns what `send` has returned, or true if it has not sent the message.
struct InterceptedSender : rtps::SenderResource {
  template <typename Interception>
  static void intercept(rtps::SenderResource& sender, Interception interception) {
    using TimePoint = std::chrono::steady_clock::time_point;
#if RMW_FASTDDS_MAJOR >= 3
    auto& function = sender.*&InterceptedSender::send_buffers_lambda_;
    function = [send = function, interception = std::move(interception)](
                   const std::vector<rtps::NetworkBuffer>& buffers, std::uint32_t size, rtps::LocatorsIterator* begin,
                   rtps::LocatorsIterator* end, const TimePoint& deadline) {
      std::array<std::uint8_t, kBeginning> joined;
      return interception(
          beginning_of(buffers, joined), size, begin, end,
          [&](rtps::LocatorsIterator* first, rtps::LocatorsIterator* last, rtps::SenderResource* other = nullptr) {
            return other != nullptr ? other->send(buffers, size, first, last, deadline)
                                    : send(buffers, size, first, last, deadline);
          });
    };
  }

 private:
  static constexpr std::size_t kBeginning = 256;

  static std::span<const std::uint8_t> beginning_of(const std::vector<rtps::NetworkBuffer>& buffers,
                                                    std::array<std::uint8_t, kBeginning>& joined) {
    if (buffers.size() == 1 || (!buffers.empty() && buffers.front().size >= kBeginning)) {
      return {static_cast<const std::uint8_t*>(buffers.front().buffer), buffers.front().size};
    }
    std::size_t size = 0;
    for (const rtps::NetworkBuffer& buffer : buffers) {
      const std::size_t part = std::min<std::size_t>(buffer.size, kBeginning - size);
      std::memcpy(joined.data() + size, buffer.buffer, part);
      size += part;
    }
    return {joined.data(), size};
  }
#else
    auto& function = sender.*&InterceptedSender::send_lambda_;
    function = [send = function, interception = std::move(interception)](
                   const rtps::octet* data, std::uint32_t size, rtps::LocatorsIterator* begin,
                   rtps::LocatorsIterator* end, const TimePoint& deadline) {
      return interception(
          {data, size}, size, begin, end,
          [&](rtps::LocatorsIterator* first, rtps::LocatorsIterator* last, rtps::SenderResource* other = nullptr) {
            return other != nullptr ? other->send(data, size, first, last, deadline)
                                    : send(data, size, first, last, deadline);
          });
    };
  }
#endif
};

// Hands everything over to `inner`, which it owns. What it sends in shared memory ends with the message
// (transport.cpp).
class ForwardingTransport : public rtps::TransportInterface {
 public:
  explicit ForwardingTransport(std::unique_ptr<TransportInterface> inner)
      : TransportInterface(inner->kind()), inner_(std::move(inner)) {}

#if RMW_FASTDDS_MAJOR >= 3 || RMW_FASTDDS_MINOR >= 14
  bool init(const rtps::PropertyPolicy* properties, const std::uint32_t& largest_message) override {
    return inner_->init(properties, largest_message) && initialised();
  }
  rtps::NetmaskFilterInfo netmask_filter_info() const override { return inner_->netmask_filter_info(); }
#else
  bool init(const rtps::PropertyPolicy* properties) override { return inner_->init(properties) && initialised(); }
#endif
#if RMW_FASTDDS_MAJOR >= 3 || RMW_FASTDDS_MINOR >= 12
  bool transform_remote_locator(const rtps::Locator& remote, rtps::Locator& result, bool remote_allows_localhost,
                                bool allows_localhost) const override {
    return is_reachable(remote) &&
           inner_->transform_remote_locator(remote, result, remote_allows_localhost, allows_localhost);
  }
  bool is_localhost_allowed() const override { return inner_->is_localhost_allowed(); }
#endif
#if RMW_FASTDDS_MAJOR >= 3
  bool is_locator_reachable(const rtps::Locator_t& locator) override { return inner_->is_locator_reachable(locator); }
#endif
  bool transform_remote_locator(const rtps::Locator& remote, rtps::Locator& result) const override {
    return is_reachable(remote) && inner_->transform_remote_locator(remote, result);
  }

  rtps::TransportDescriptorInterface* get_configuration() override { return inner_->get_configuration(); }
  bool IsInputChannelOpen(const rtps::Locator& locator) const override { return inner_->IsInputChannelOpen(locator); }
  bool IsLocatorSupported(const rtps::Locator& locator) const override { return inner_->IsLocatorSupported(locator); }
  bool is_locator_allowed(const rtps::Locator& locator) const override { return inner_->is_locator_allowed(locator); }
  rtps::Locator RemoteToMainLocal(const rtps::Locator& remote) const override {
    return inner_->RemoteToMainLocal(remote);
  }
  bool OpenOutputChannel(rtps::SendResourceList& senders, const rtps::Locator& locator) override;
  bool OpenInputChannel(const rtps::Locator& locator, rtps::TransportReceiverInterface* receiver,
                        std::uint32_t largest_message) override {
    return inner_->OpenInputChannel(locator, receiver, largest_message);
  }
  bool CloseInputChannel(const rtps::Locator& locator) override { return inner_->CloseInputChannel(locator); }
  bool DoInputLocatorsMatch(const rtps::Locator& left, const rtps::Locator& right) const override {
    return inner_->DoInputLocatorsMatch(left, right);
  }
  rtps::LocatorList NormalizeLocator(const rtps::Locator& locator) override {
    return inner_->NormalizeLocator(locator);
  }
  void select_locators(rtps::LocatorSelector& selector) const override { inner_->select_locators(selector); }
  bool is_local_locator(const rtps::Locator& locator) const override { return inner_->is_local_locator(locator); }
  void AddDefaultOutputLocator(rtps::LocatorList& list) override { inner_->AddDefaultOutputLocator(list); }
  bool getDefaultMetatrafficMulticastLocators(rtps::LocatorList& locators, std::uint32_t port) const override {
    return inner_->getDefaultMetatrafficMulticastLocators(locators, port);
  }
  bool getDefaultMetatrafficUnicastLocators(rtps::LocatorList& locators, std::uint32_t port) const override {
    return inner_->getDefaultMetatrafficUnicastLocators(locators, port);
  }
  bool getDefaultUnicastLocators(rtps::LocatorList& locators, std::uint32_t port) const override {
    return inner_->getDefaultUnicastLocators(locators, port);
  }
  bool fillMetatrafficMulticastLocator(rtps::Locator& locator, std::uint32_t port) const override {
    return inner_->fillMetatrafficMulticastLocator(locator, port);
  }
  bool fillMetatrafficUnicastLocator(rtps::Locator& locator, std::uint32_t port) const override {
    return inner_->fillMetatrafficUnicastLocator(locator, port);
  }
  bool configureInitialPeerLocator(rtps::Locator& locator, const rtps::PortParameters& ports, std::uint32_t domain_id,
                                   rtps::LocatorList& list) const override {
    return inner_->configureInitialPeerLocator(locator, ports, domain_id, list);
  }
  bool fillUnicastLocator(rtps::Locator& locator, std::uint32_t port) const override {
    return inner_->fillUnicastLocator(locator, port);
  }
  std::uint32_t max_recv_buffer_size() const override { return inner_->max_recv_buffer_size(); }
  void shutdown() override { inner_->shutdown(); }
  void update_network_interfaces() override { inner_->update_network_interfaces(); }

 protected:
  // Called when `inner` is initialised. False: the transport cannot be used.
  virtual bool initialised() { return true; }

  // Ends the threads of `inner`, which call what a derived class holds. For its destructor.
  void end() { inner_.reset(); }

 private:
  // Fast DDS prefers shared memory to UDP, and writes what nobody reads where the port or the segment cannot be opened:
  //   between Fast DDS 2 and 3, which give their ports other names; neither tells the other which it is
  //   between containers with one network and several /dev/shm
  //   between two users, whose files only they may write; a reader opens the segment of the writer for writing
  // So a port must be there and must be of this user; else UDP is used. Version 3 looks itself whether it is there
  // (is_locator_reachable).
  bool is_reachable(const rtps::Locator& locator) const;

  std::unique_ptr<TransportInterface> inner_;
};

// The file of the port of a locator in shared memory.
std::string shared_memory_port_file(std::uint32_t port);

}  // namespace rmw_fastrtps
