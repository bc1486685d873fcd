// SPDX-License-Identifier: Apache-2.0
#include "fastdds_versions/profile_transports.hpp"

#include <cstdlib>
#include <memory>
#include <typeinfo>

#include "fastdds_versions/separate_memory.hpp"
#include "fastdds_versions/transport.hpp"

namespace rmw_fastrtps {

namespace {

// Stays a descriptor of its kind, because Fast DDS looks for it.
template <typename Descriptor>
struct Forwarded final : Descriptor {
  explicit Forwarded(const Descriptor& of_profile) : Descriptor(of_profile) {}

  rtps::TransportInterface* create_transport() const override {
    return new ForwardingTransport(
        with_separate_memory(std::unique_ptr<rtps::TransportInterface>(Descriptor::create_transport())));
  }
};

// Replaces a descriptor that is of this kind, and not of one that is derived from it.
template <typename Descriptor>
void forward(std::shared_ptr<rtps::TransportDescriptorInterface>& descriptor) {
  const auto& kept = *descriptor;
  if (typeid(kept) == typeid(Descriptor)) {
    descriptor = std::make_shared<Forwarded<Descriptor>>(static_cast<const Descriptor&>(kept));
  }
}

// The transports that Fast DDS would add, with the sizes of the profile for UDP.
void add_builtin_transports(fdds::TransportConfigQos& transports) {
  auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  udp->sendBufferSize = transports.send_socket_buffer_size;
  udp->receiveBufferSize = transports.listen_socket_buffer_size;
#if RMW_FASTDDS_MAJOR >= 3
  udp->default_reception_threads(transports.builtin_transports_reception_threads_);
#endif
  auto shared_memory = std::make_shared<rtps::SharedMemTransportDescriptor>();
  shared_memory->max_message_size(udp->max_message_size());
#if RMW_FASTDDS_MAJOR >= 3
  shared_memory->default_reception_threads(transports.builtin_transports_reception_threads_);
#endif
  transports.user_transports.push_back(shared_memory);
  transports.user_transports.push_back(udp);
  transports.use_builtin_transports = false;
}

}  // namespace

void forward_shared_memory(fdds::DomainParticipantQos& qos) {
  auto& transports = qos.transport();
  if (transports.use_builtin_transports && std::getenv("FASTDDS_BUILTIN_TRANSPORTS") == nullptr) {
    add_builtin_transports(transports);
  }
  for (auto& descriptor : transports.user_transports) {
    forward<rtps::SharedMemTransportDescriptor>(descriptor);
    if (RMW_FASTDDS_HAS_MEMORY_OF_ITS_OWN) {  // announcements come by UDP, too
      forward<rtps::UDPv4TransportDescriptor>(descriptor);
      forward<rtps::UDPv6TransportDescriptor>(descriptor);
    }
  }
}

}  // namespace rmw_fastrtps
