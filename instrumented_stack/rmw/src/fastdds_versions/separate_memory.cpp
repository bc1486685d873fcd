// SPDX-License-Identifier: Apache-2.0
#include "fastdds_versions/separate_memory.hpp"

#include <utility>

#include "fastdds_versions/transport.hpp"

namespace rmw_fastrtps {

#if RMW_FASTDDS_HAS_MEMORY_OF_ITS_OWN

namespace {

using rtps::Locator;

// Names another host, or that host again. Twice, it changes nothing.
void change_hosts(std::span<std::uint8_t> message, const std::vector<std::size_t>& hosts) {
  for (const std::size_t host : hosts) {
    message[host] ^= 0x29;
    message[host + 1] ^= 0x91;
  }
}

// As the transport in shared memory gets it.
Locator with_file_number(Locator locator) {
  if (locator.kind == LOCATOR_KIND_SHM) {
    locator.port = shared_memory_file_number(locator.port);
  }
  return locator;
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"  // the destructor of the base

// Gives what another iterator gives, as the transport in shared memory gets it. It moves the other one.
class LocatorsWithFileNumbers final : public rtps::LocatorsIterator {
 public:
  explicit LocatorsWithFileNumbers(rtps::LocatorsIterator& locators) : locators_(locators) {}

  LocatorsIterator& operator++() override {
    ++locators_;
    return *this;
  }
  bool operator==(const LocatorsIterator& other) const override {
    return locators_ == static_cast<const LocatorsWithFileNumbers&>(other).locators_;
  }
  bool operator!=(const LocatorsIterator& other) const override { return !(*this == other); }
  const Locator& operator*() const override {
    current_ = with_file_number(*locators_);
    return current_;
  }

 private:
  rtps::LocatorsIterator& locators_;
  mutable Locator current_;
};

#pragma GCC diagnostic pop

// Of messages, only announcements of participants and endpoints are copied.
struct SeparateSender : rtps::SenderResource {
  static void become(rtps::SenderResource& sender, bool is_shared_memory) {
    auto& function = sender.*&SeparateSender::send_lambda_;
    function = [send = function, is_shared_memory](const rtps::octet* data, std::uint32_t size,
                                                   rtps::LocatorsIterator* begin, rtps::LocatorsIterator* end,
                                                   const std::chrono::steady_clock::time_point& deadline) {
      const std::vector<std::size_t> hosts = announced_hosts({data, size});
      std::vector<rtps::octet> changed;
      if (!hosts.empty()) {
        changed.assign(data, data + size);
        change_hosts(changed, hosts);
        data = changed.data();
      }
      if (!is_shared_memory) {
        return send(data, size, begin, end, deadline);
      }
      LocatorsWithFileNumbers first(*begin);
      LocatorsWithFileNumbers last(*end);
      return send(data, size, &first, &last, deadline);
    };
  }
};

class SeparateReceiver final : public rtps::TransportReceiverInterface {
 public:
  explicit SeparateReceiver(rtps::TransportReceiverInterface& receiver) : receiver_(receiver) {}

  void OnDataReceived(const rtps::octet* data, std::uint32_t size, const Locator& local,
                      const Locator& remote) override {
    const std::vector<std::size_t> hosts = announced_hosts({data, size});
    if (hosts.empty()) {
      receiver_.OnDataReceived(data, size, local, remote);
      return;
    }
    std::vector<rtps::octet> changed(data, data + size);
    change_hosts(changed, hosts);
    receiver_.OnDataReceived(changed.data(), size, local, remote);
  }

 private:
  rtps::TransportReceiverInterface& receiver_;
};

class SeparateTransport final : public ForwardingTransport {
 public:
  using ForwardingTransport::ForwardingTransport;
  ~SeparateTransport() override { end(); }

  bool IsInputChannelOpen(const Locator& locator) const override {
    return ForwardingTransport::IsInputChannelOpen(with_file_number(locator));
  }
  bool OpenOutputChannel(rtps::SendResourceList& senders, const Locator& locator) override {
    const std::size_t before = senders.size();
    if (!ForwardingTransport::OpenOutputChannel(senders, with_file_number(locator))) {
      return false;
    }
    for (std::size_t i = before; i < senders.size(); ++i) {
      SeparateSender::become(*senders[i], kind() == LOCATOR_KIND_SHM);
    }
    return true;
  }
  bool OpenInputChannel(const Locator& locator, rtps::TransportReceiverInterface* receiver,
                        std::uint32_t largest_message) override {
    receivers_.push_back(std::make_unique<SeparateReceiver>(*receiver));
    return ForwardingTransport::OpenInputChannel(with_file_number(locator), receivers_.back().get(), largest_message);
  }
  bool CloseInputChannel(const Locator& locator) override {
    return ForwardingTransport::CloseInputChannel(with_file_number(locator));
  }

 private:
  std::vector<std::unique_ptr<SeparateReceiver>> receivers_;  // outlive the threads of the transport behind this one
};

}  // namespace

std::unique_ptr<rtps::TransportInterface> with_separate_memory(std::unique_ptr<rtps::TransportInterface> transport) {
  return std::make_unique<SeparateTransport>(std::move(transport));
}

#else

std::unique_ptr<rtps::TransportInterface> with_separate_memory(std::unique_ptr<rtps::TransportInterface> transport) {
  return transport;
}

#endif

}  // namespace rmw_fastrtps
