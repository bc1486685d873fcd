// SPDX-License-Identifier: Apache-2.0
#include "participant/default_transports.hpp"

#include <pwd.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fastdds_versions/separate_memory.hpp"
#include "fastdds_versions/transport.hpp"
#include "participant/large_messages.hpp"
#include "participant/own_ports.hpp"
#include "rcutils/logging.h"

namespace rmw_fastrtps {
namespace {

// What small messages need of its segment, and its ports.
constexpr std::uint64_t kMemoryOfParticipant = 1024 * 1024;

using rtps::Locator;

// What a transport tells Fast DDS about itself.
struct ReportedConfiguration : rtps::TransportDescriptorInterface {
  explicit ReportedConfiguration(const rtps::TransportDescriptorInterface& of_transport)
      : TransportDescriptorInterface(of_transport.max_message_size(), of_transport.max_initial_peers_range()) {}

  rtps::TransportInterface* create_transport() const override { return nullptr; }
  std::uint32_t min_send_buffer_size() const override { return kBytesBetweenHeartbeats; }
};

// Those of one kind, or all for kind 0.
std::vector<Locator> between(rtps::LocatorsIterator& begin, const rtps::LocatorsIterator& end, std::int32_t kind) {
  std::vector<Locator> locators;
  for (; begin != end; ++begin) {
    if (kind == 0 || (*begin).kind == kind) {
      locators.push_back(*begin);
    }
  }
  return locators;
}

// Lets what `traffic` allows pass to the transport behind a sender, or to that of `large`, if there is one. `open`
// is told the destinations before something is sent to them; it may be empty. `kind` is that of the transport.
void filter(rtps::SenderResource& sender, std::int32_t kind, const std::shared_ptr<DiscoveryTraffic>& traffic,
            const std::shared_ptr<LargeMessages>& large, std::function<void(const std::vector<Locator>&)> open) {
  const auto interception = [kind, traffic, large, open = std::move(open)](
                                std::span<const std::uint8_t> bytes, std::uint32_t size, rtps::LocatorsIterator* begin,
                                rtps::LocatorsIterator* end, const auto& send) {
    if (!traffic->is_introduced()) {
      return true;
    }
    const auto message = discovery_message_in(bytes);
    const bool is_large = large && LargeMessages::is_large(size);
    if (!message && !is_large && !open) {
      return send(begin, end);
    }
    std::vector<Locator> destinations = between(*begin, *end, message ? 0 : kind);
    if (message) {
      traffic->restrict(*message, destinations, std::chrono::steady_clock::now());
    }
    if (open) {
      open(destinations);
    }
    rtps::SenderResource* const other = is_large ? large->sender(destinations) : nullptr;
    rtps::Locators first(destinations.begin());
    rtps::Locators last(destinations.end());
    return destinations.empty() || send(&first, &last, other);
  };
  InterceptedSender::intercept(sender, interception);
}

// Hands over what `traffic` lets hear.
class FilteredReceiver final : public rtps::TransportReceiverInterface {
 public:
  FilteredReceiver(rtps::TransportReceiverInterface& receiver, std::shared_ptr<DiscoveryTraffic> traffic,
                   std::shared_ptr<OwnPorts> ports)
      : receiver_(receiver), traffic_(std::move(traffic)), ports_(std::move(ports)) {}

  void OnDataReceived(const rtps::octet* data, std::uint32_t size, const Locator& local,
                      const Locator& remote) override {
    if (!traffic_->is_introduced()) {
      return;
    }
    const auto message = discovery_message_in({data, size});
    const auto now = std::chrono::steady_clock::now();
    if (message && local.kind != LOCATOR_KIND_SHM) {
      ports_->check(now);
    }
    if (!message || traffic_->is_heard(*message, local.kind, now)) {
      receiver_.OnDataReceived(data, size, local, remote);
    }
  }

 private:
  rtps::TransportReceiverInterface& receiver_;
  const std::shared_ptr<DiscoveryTraffic> traffic_;
  const std::shared_ptr<OwnPorts> ports_;
};

// Hands everything over to `inner`, except for its configuration. Messages pass by `traffic`.
class FilteredTransport final : public ForwardingTransport {
 public:
  FilteredTransport(std::unique_ptr<TransportInterface> inner, std::shared_ptr<DiscoveryTraffic> traffic,
                    std::shared_ptr<OwnPorts> ports, std::uint32_t largest_message)
      : ForwardingTransport(std::move(inner)), traffic_(std::move(traffic)), ports_(std::move(ports)) {
    if (is_shared_memory()) {
      large_ = std::make_shared<LargeMessages>(largest_message);
    }
  }
  ~FilteredTransport() override {
    ports_->all_closed();
    end();
  }

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
      filter(*senders[i], kind(), traffic_, large_, is_shared_memory() ? nullptr : opener());
    }
    open_.insert(locator);
    return true;
  }
  bool OpenInputChannel(const Locator& locator, rtps::TransportReceiverInterface* receiver,
                        std::uint32_t max_message_size) override {
    receivers_.push_back(std::make_unique<FilteredReceiver>(*receiver, traffic_, ports_));
    auto* filtered = receivers_.back().get();
    if (!ForwardingTransport::OpenInputChannel(locator, filtered, max_message_size)) {
      return false;
    }
    // Ports of groups are shared with others, and Fast DDS sends nothing to them.
    if (locator.kind == LOCATOR_KIND_SHM && locator.address[0] != 'M') {
      ports_->opened(
          locator.port, [this, locator] { ForwardingTransport::CloseInputChannel(locator); },
          [this, locator, filtered, max_message_size] {
            ForwardingTransport::OpenInputChannel(locator, filtered, max_message_size);
          });
    }
    return true;
  }
  bool CloseInputChannel(const Locator& locator) override {
    if (locator.kind == LOCATOR_KIND_SHM) {
      ports_->closed(locator.port);
    }
    return ForwardingTransport::CloseInputChannel(locator);
  }
  void update_network_interfaces() override {
    ForwardingTransport::update_network_interfaces();
    interfaces_changed_ = true;
  }

 private:
  bool is_shared_memory() const { return kind() == LOCATOR_KIND_SHM; }

  // Fast DDS with statistics ends the process when it sends to a locator whose channel was never opened. It opens those
  // that it has chosen when it found a reader, and chooses others when it sends to some of its readers alone: where
  // several listen to one multicast address, as those of Cyclone DDS do, it has opened that one alone.
  std::function<void(const std::vector<Locator>&)> opener() {
    return [this](const std::vector<Locator>& destinations) {
      for (const Locator& locator : destinations) {
        if (locator.kind == kind() && open_.count(locator) == 0 && !interfaces_changed_) {
          rtps::SendResourceList none;  // the sockets are there
          ForwardingTransport::OpenOutputChannel(none, locator);
          open_.insert(locator);
        }
      }
    };
  }

  bool initialised() override {
    configuration_.emplace(*ForwardingTransport::get_configuration());
    return true;
  }

  const std::shared_ptr<DiscoveryTraffic> traffic_;
  const std::shared_ptr<OwnPorts> ports_;
  std::shared_ptr<LargeMessages> large_;                      // of shared memory
  std::vector<std::unique_ptr<FilteredReceiver>> receivers_;  // outlive the threads of the transport behind this one
  std::optional<ReportedConfiguration> configuration_;
  std::set<Locator> open_;  // Fast DDS opens one at a time
  std::atomic<bool> interfaces_changed_{false};
};

// Stays a descriptor of its kind, because Fast DDS looks for the one of shared memory.
template <typename Descriptor>
struct Filtered final : Descriptor {
  Filtered(std::shared_ptr<DiscoveryTraffic> of_participant, std::shared_ptr<OwnPorts> ports_of_participant)
      : traffic(std::move(of_participant)), ports(std::move(ports_of_participant)) {}

  rtps::TransportInterface* create_transport() const override {
    return new FilteredTransport(
        with_separate_memory(std::unique_ptr<rtps::TransportInterface>(Descriptor::create_transport())), traffic, ports,
        Descriptor::max_message_size());
  }

  std::shared_ptr<DiscoveryTraffic> traffic;
  std::shared_ptr<OwnPorts> ports;
};

std::string name_of_user(uid_t user) {
  const passwd* entry = getpwuid(user);
  return entry != nullptr ? entry->pw_name : std::to_string(user);
}

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

std::optional<BuiltinTransports> wanted_builtin_transports() {
  const char* value = std::getenv("FASTDDS_BUILTIN_TRANSPORTS");
  const std::string_view wanted = value == nullptr ? "" : value;
  static constexpr std::array<std::pair<std::string_view, BuiltinTransports>, 6> kKnown = {
      {{"", {}},
       {"DEFAULT", {}},
       {"DEFAULTv6", {.udp4 = false, .udp6 = true}},
       {"SHM", {.udp4 = false}},
       {"UDPv4", {.shared_memory = false}},
       {"UDPv6", {.udp4 = false, .udp6 = true, .shared_memory = false}}}};
  for (auto [name, transports] : kKnown) {
    if (name == wanted) {
      transports.are_of_environment = !wanted.empty();
      return transports;
    }
  }
  static constexpr std::array<std::string_view, 5> kOfFastDds = {"NONE", "TCPv4", "TCPv6", "LARGE_DATA",
                                                                 "LARGE_DATAv6"};
  const std::string_view name = wanted.substr(0, wanted.find('?'));
  const bool is_name = std::find(kOfFastDds.begin(), kOfFastDds.end(), name) != kOfFastDds.end() ||
                       std::any_of(kKnown.begin(), kKnown.end(),
                                   [&](const auto& known) { return known.first == name && !name.empty(); });
  constexpr bool kFastDdsReadsIt = RMW_FASTDDS_MAJOR >= 3 || RMW_FASTDDS_MINOR >= 12;
  if (is_name && kFastDdsReadsIt) {
    return std::nullopt;
  }
  rcutils_log(nullptr, RCUTILS_LOG_SEVERITY_WARN, "rmw_fastrtps",
              is_name
                  ? "FASTDDS_BUILTIN_TRANSPORTS is '%s', which this release of Fast DDS does not have; using DEFAULT"
                  : "FASTDDS_BUILTIN_TRANSPORTS is '%s', but must be DEFAULT, DEFAULTv6, SHM, UDPv4, UDPv6, TCPv4, "
                    "TCPv6, LARGE_DATA, LARGE_DATAv6 or NONE; using DEFAULT",
              value);
  return BuiltinTransports{};
}

void warn_of_another_user(std::uint32_t domain_id, const fdds::DomainParticipantQos& qos) {
  const auto& transports = qos.transport();
  const bool is_alone =
      !transports.use_builtin_transports &&
      std::all_of(transports.user_transports.begin(), transports.user_transports.end(), [](const auto& transport) {
        return std::dynamic_pointer_cast<rtps::SharedMemTransportDescriptor>(transport) != nullptr;
      });
  const std::string port = shared_memory_port_file(qos.wire_protocol().port.getMulticastPort(domain_id));
  struct stat status {};
  if (!is_alone || stat(port.c_str(), &status) != 0 || status.st_uid == geteuid()) {
    return;
  }
  rcutils_log(
      nullptr, RCUTILS_LOG_SEVERITY_WARN, "rmw_fastrtps",
      "Nodes of the users '%s' and '%s' do not hear each other in domain %u: shared memory is the only transport, "
      "and %s belongs to '%s'. Use UDP as well (FASTDDS_BUILTIN_TRANSPORTS=DEFAULT), or one user for both",
      name_of_user(geteuid()).c_str(), name_of_user(status.st_uid).c_str(), domain_id, port.c_str(),
      name_of_user(status.st_uid).c_str());
}

void use_default_transports(const BuiltinTransports& wanted, std::uint32_t local_peers,
                            const std::shared_ptr<DiscoveryTraffic>& traffic, fdds::DomainParticipantQos& qos) {
  const auto ports = std::make_shared<OwnPorts>();
  qos.transport().use_builtin_transports = false;
  auto& transports = qos.transport().user_transports;
  transports.clear();
  const auto add_udp = [&]<typename Descriptor>(std::shared_ptr<Filtered<Descriptor>> udp) {
    if (local_peers != 0) {
      udp->maxInitialPeersRange = local_peers;
    }
    udp->sendBufferSize = qos.transport().send_socket_buffer_size;
    udp->receiveBufferSize = qos.transport().listen_socket_buffer_size;
    transports.push_back(std::move(udp));
  };
  const rtps::UDPv4TransportDescriptor udp;
  if (wanted.udp4) {
    add_udp(std::make_shared<Filtered<rtps::UDPv4TransportDescriptor>>(traffic, ports));
  }
  if (wanted.udp6) {
    add_udp(std::make_shared<Filtered<rtps::UDPv6TransportDescriptor>>(traffic, ports));
  }
  if (!wanted.shared_memory) {
    return;
  }
  const bool is_alone = transports.empty();
  if (is_alone || has_room_in_shared_memory(kMemoryOfParticipant)) {
    auto shared_memory = std::make_shared<Filtered<rtps::SharedMemTransportDescriptor>>(traffic, ports);
    shared_memory->max_message_size(udp.max_message_size());
    transports.push_back(shared_memory);
  } else {
    rcutils_log(nullptr, RCUTILS_LOG_SEVERITY_WARN, "rmw_fastrtps",
                "/dev/shm is full: messages to processes of this host take the way over UDP");
  }
}

}  // namespace rmw_fastrtps
