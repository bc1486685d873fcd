// SPDX-License-Identifier: Apache-2.0
#include "participant/default_transports.hpp"

#include <sys/statvfs.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "fastdds_versions/transport.hpp"
#include "rcutils/logging.h"

namespace rmw_fastrtps {
namespace {

// Its segment of 512 KiB, and its ports.
constexpr std::uint64_t kMemoryOfParticipant = 1024 * 1024;

using rtps::Locator;

// What a transport tells Fast DDS about itself.
struct ReportedConfiguration : rtps::TransportDescriptorInterface {
  explicit ReportedConfiguration(const rtps::TransportDescriptorInterface& of_transport)
      : TransportDescriptorInterface(of_transport.max_message_size(), of_transport.max_initial_peers_range()) {}

  rtps::TransportInterface* create_transport() const override { return nullptr; }
  std::uint32_t min_send_buffer_size() const override { return kBytesBetweenHeartbeats; }
};

// Lets what `traffic` allows pass to the transport behind a sender.
void filter(rtps::SenderResource& sender, const std::shared_ptr<DiscoveryTraffic>& traffic) {
  InterceptedSender::intercept(sender, [traffic](std::span<const std::uint8_t> bytes, rtps::LocatorsIterator* begin,
                                                 rtps::LocatorsIterator* end, const auto& send) {
    if (!traffic->is_introduced()) {
      return true;
    }
    const auto message = discovery_message_in(bytes);
    if (!message) {
      return send(begin, end);
    }
    std::vector<Locator> destinations;
    for (; *begin != *end; ++*begin) {
      destinations.push_back(**begin);
    }
    traffic->restrict(*message, destinations, std::chrono::steady_clock::now());
    rtps::Locators first(destinations.begin());
    rtps::Locators last(destinations.end());
    return destinations.empty() || send(&first, &last);
  });
}

// Hands over what `traffic` lets hear.
class FilteredReceiver final : public rtps::TransportReceiverInterface {
 public:
  FilteredReceiver(rtps::TransportReceiverInterface& receiver, std::shared_ptr<DiscoveryTraffic> traffic)
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
  rtps::TransportReceiverInterface& receiver_;
  const std::shared_ptr<DiscoveryTraffic> traffic_;
};

// Hands everything over to `inner`, except for its configuration. Messages pass by `traffic`.
class FilteredTransport final : public ForwardingTransport {
 public:
  FilteredTransport(std::unique_ptr<TransportInterface> inner, std::shared_ptr<DiscoveryTraffic> traffic)
      : ForwardingTransport(std::move(inner)), traffic_(std::move(traffic)) {}
  ~FilteredTransport() override { end(); }

  rtps::TransportDescriptorInterface* get_configuration() override { return &*configuration_; }

  // Fast DDS asks for the channels to all known participants whenever it finds one more.
  bool OpenOutputChannel(rtps::SendResourceList& senders, const Locator& locator) override {
    if (interfaces_changed_.exchange(false)) {
      open_.clear();
    }
    if (open_.count(locator) != 0) {
      return true;
    }
    const std::size_t before = senders.size();
    if (!ForwardingTransport::OpenOutputChannel(senders, locator)) {
      return false;
    }
    for (std::size_t i = before; i < senders.size(); ++i) {
      filter(*senders[i], traffic_);
    }
    open_.insert(locator);
    return true;
  }
  bool OpenInputChannel(const Locator& locator, rtps::TransportReceiverInterface* receiver,
                        std::uint32_t max_message_size) override {
    receivers_.push_back(std::make_unique<FilteredReceiver>(*receiver, traffic_));
    return ForwardingTransport::OpenInputChannel(locator, receivers_.back().get(), max_message_size);
  }
  void update_network_interfaces() override {
    ForwardingTransport::update_network_interfaces();
    interfaces_changed_ = true;
  }

 private:
  bool initialised() override {
    configuration_.emplace(*ForwardingTransport::get_configuration());
    return true;
  }

  const std::shared_ptr<DiscoveryTraffic> traffic_;
  std::vector<std::unique_ptr<FilteredReceiver>> receivers_;  // outlive the threads of the transport behind this one
  std::optional<ReportedConfiguration> configuration_;
  std::set<Locator> open_;  // Fast DDS opens one at a time
  std::atomic<bool> interfaces_changed_{false};
};

// Stays a descriptor of its kind, because Fast DDS looks for the one of shared memory.
template <typename Descriptor>
struct Filtered final : Descriptor {
  explicit Filtered(std::shared_ptr<DiscoveryTraffic> of_participant) : traffic(std::move(of_participant)) {}

  rtps::TransportInterface* create_transport() const override {
    return new FilteredTransport(std::unique_ptr<rtps::TransportInterface>(Descriptor::create_transport()), traffic);
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
  auto udp = std::make_shared<Filtered<rtps::UDPv4TransportDescriptor>>(traffic);
  if (local_peers != 0) {
    udp->maxInitialPeersRange = local_peers;
  }
  auto shared_memory = std::make_shared<Filtered<rtps::SharedMemTransportDescriptor>>(traffic);
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
