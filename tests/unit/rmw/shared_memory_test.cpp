// SPDX-License-Identifier: Apache-2.0
// What the transports of rmw send in shared memory arrives as it was sent.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fstream>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "fastdds_versions/profile_transports.hpp"
#include "fastdds_versions/shared_memory_layout.hpp"
#include "fastdds_versions/transport.hpp"
#include "participant/default_transports.hpp"
#include "tests/support/emulated.hpp"

namespace {

using rmw_fastrtps::DiscoveryTraffic;
using testing::ElementsAre;
namespace fdds = eprosima::fastdds::dds;
namespace rtps = rmw_fastrtps::rtps;

constexpr std::uint32_t kLargestMessage = 65500;

// Of this process alone, and none of the ports that participants have.
rtps::Locator_t own_port() {
  rtps::Locator_t port(LOCATOR_KIND_SHM, 0x40000000U + static_cast<std::uint32_t>(::getpid()));
  port.address[0] = 'U';
  return port;
}

class Arrived final : public rtps::TransportReceiverInterface {
 public:
  void OnDataReceived(const rtps::octet* data, std::uint32_t size, const rtps::Locator_t&,
                      const rtps::Locator_t&) override {
    const std::lock_guard lock(mutex_);
    messages_.emplace_back(reinterpret_cast<const char*>(data), size);
    changed_.notify_all();
  }

  std::optional<std::string> next(std::chrono::milliseconds patience = std::chrono::seconds(30)) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, patience, [this] { return !messages_.empty(); })) {
      return std::nullopt;
    }
    std::string message = std::move(messages_.front());
    messages_.pop_front();
    return message;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> messages_;
};

// Sends a message that is made of these parts.
void send(rtps::SenderResource& sender, const rtps::Locator_t& to, const std::vector<std::string>& parts) {
  const std::vector<rtps::Locator_t> destinations{to};
  rtps::Locators begin(destinations.begin());
  rtps::Locators end(destinations.end());
  const std::string whole = std::accumulate(parts.begin(), parts.end(), std::string());
  const auto size = static_cast<std::uint32_t>(whole.size());
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
#if RMW_FASTDDS_MAJOR >= 3
  std::vector<rtps::NetworkBuffer> buffers;
  for (const std::string& part : parts) {
    buffers.emplace_back(part.data(), static_cast<std::uint32_t>(part.size()));
  }
  EXPECT_TRUE(sender.send(buffers, size, &begin, &end, deadline));
#else
  EXPECT_TRUE(sender.send(reinterpret_cast<const rtps::octet*>(whole.data()), size, &begin, &end, deadline));
#endif
}

// Version 3 hands statistics to a transport as the last part, 60 bytes with their header.
std::vector<std::string> as_fast_dds_sends(const std::string& message) {
  return RMW_FASTDDS_MAJOR >= 3 ? std::vector{message, std::string("\x80\x01\x38\0", 4) + std::string(56, 's')}
                                : std::vector{message};
}

// Sends a short message after a long one. The short one gets memory that the long one has had.
void expect_whole_messages(const rtps::TransportDescriptorInterface& descriptor) {
  const std::unique_ptr<rtps::TransportInterface> transport(descriptor.create_transport());
  ASSERT_TRUE(transport->init());
  const rtps::Locator_t here = own_port();
  Arrived arrived;
  ASSERT_TRUE(transport->OpenInputChannel(here, &arrived, kLargestMessage));
  rtps::SendResourceList senders;
  ASSERT_TRUE(transport->OpenOutputChannel(senders, here));
  ASSERT_EQ(senders.size(), 1U);
  for (const std::string& message : {std::string(1000, 'l'), std::string(40, 's')}) {
    send(*senders.front(), here, as_fast_dds_sends(message));
    EXPECT_EQ(arrived.next(), message);
  }
  senders.clear();
  EXPECT_TRUE(transport->CloseInputChannel(here));
  transport->shutdown();
}

// Fast DDS 3.1.2 sends 60 bytes of an older message behind each one. A participant that was asked for its endpoints
// took such an end for the acknowledgement of all of them, which another process had got, and never sent them.
TEST(SharedMemory, AMessageEndsWhereItEnds) {
  fdds::DomainParticipantQos qos;
  const auto traffic = std::make_shared<DiscoveryTraffic>();
  traffic->introduce({});
  rmw_fastrtps::use_default_transports({}, 0, traffic, qos);
  ASSERT_EQ(qos.transport().user_transports.size(), 2U);
  expect_whole_messages(*qos.transport().user_transports.back());
}

// A reader that is as slow as can be.
class HeldReader final : public rtps::TransportReceiverInterface {
 public:
  void OnDataReceived(const rtps::octet*, std::uint32_t, const rtps::Locator_t&, const rtps::Locator_t&) override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return released_; });
    ++number_;
    changed_.notify_all();
  }
  void release() {
    const std::lock_guard lock(mutex_);
    released_ = true;
    changed_.notify_all();
  }
  bool wait_for(int number) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(30), [&] { return number_ >= number; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool released_ = false;
  int number_ = 0;
};

// What the segments take that this process has mapped.
std::uint64_t memory_of_segments() {
  static const std::regex kSegment("/dev/shm/fast(rtps|dds)_[0-9a-f]{16}$");
  std::set<std::string> files;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::smatch segment;
    if (std::regex_search(line, segment, kSegment)) {
      files.insert(segment.str());
    }
  }
  std::uint64_t bytes = 0;
  for (const std::string& file : files) {
    struct stat status {};
    if (stat(file.c_str(), &status) == 0) {
      bytes += static_cast<std::uint64_t>(status.st_blocks) * 512;
    }
  }
  return bytes;
}

// A message of 16 MiB has so many parts. One that finds no place is lost, and the message with it.
TEST(SharedMemory, ALargeMessageHasPlaceAlthoughNobodyReads) {
  if (!rmw_fastrtps::has_room_in_shared_memory(std::uint64_t{512} << 20)) {
    GTEST_SKIP() << "skipped, because /dev/shm has less than 512 MiB";
  }
  constexpr int kParts = 257;
  fdds::DomainParticipantQos qos;
  const auto traffic = std::make_shared<DiscoveryTraffic>();
  traffic->introduce({});
  rmw_fastrtps::use_default_transports({.udp4 = false}, 0, traffic, qos);
  const std::unique_ptr<rtps::TransportInterface> transport(qos.transport().user_transports.at(0)->create_transport());
  ASSERT_TRUE(transport->init());
  const rtps::Locator_t here = own_port();
  HeldReader reader;
  ASSERT_TRUE(transport->OpenInputChannel(here, &reader, kLargestMessage));
  rtps::SendResourceList senders;
  ASSERT_TRUE(transport->OpenOutputChannel(senders, here));
  send(*senders.front(), here, as_fast_dds_sends("small"));
  EXPECT_LE(memory_of_segments(), std::uint64_t{1} << 20);  // that of large messages is not there before one is sent
  const std::string part(kLargestMessage, 'p');
  for (int i = 0; i < kParts; ++i) {
    send(*senders.front(), here, as_fast_dds_sends(part));
  }
  EXPECT_GE(memory_of_segments(), std::uint64_t{16} << 20);
  reader.release();
  EXPECT_TRUE(reader.wait_for(kParts + 1));
  senders.clear();
  EXPECT_TRUE(transport->CloseInputChannel(here));
  transport->shutdown();
}

// Fast DDS sends to such a locator when it has found several readers that listen to one multicast address, as those of
// Cyclone DDS do, and ended the process then.
TEST(Udp, AMessageGoesToALocatorWhoseChannelWasNeverOpened) {
  NEEDS_NETWORK_DEVICES();
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), length), 0);
  ASSERT_EQ(::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &length), 0);

  fdds::DomainParticipantQos qos;
  const auto traffic = std::make_shared<DiscoveryTraffic>();
  traffic->introduce({});
  rmw_fastrtps::use_default_transports({.shared_memory = false}, 0, traffic, qos);
  const std::unique_ptr<rtps::TransportInterface> transport(qos.transport().user_transports.at(0)->create_transport());
  ASSERT_TRUE(transport->init());
  rtps::Locator_t here;
  here.kind = LOCATOR_KIND_UDPv4;
  std::copy_n(std::array<rtps::octet, 4>{127, 0, 0, 1}.begin(), 4, here.address + 12);
  here.port = ntohs(address.sin_port);
  rtps::Locator_t other = here;
  other.port = here.port == 1 ? 2 : here.port - 1;
  rtps::SendResourceList senders;
  ASSERT_TRUE(transport->OpenOutputChannel(senders, other));
  ASSERT_FALSE(senders.empty());
  const std::string message = "RTPS" + std::string(60, 'm');
  send(*senders.front(), here, as_fast_dds_sends(message));
  std::array<char, 1000> got{};
  const ssize_t size = ::recv(socket, got.data(), got.size(), 0);
  EXPECT_EQ(std::string(got.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))).substr(0, message.size()),
            message);
  senders.clear();
  transport->shutdown();
  ::close(socket);
}

// The kinds of the submessages, and 0 for what is none.
std::vector<int> submessages(const std::string& message) {
  std::vector<int> kinds;
  std::size_t at = 20;  // behind the header
  while (at + 4 <= message.size()) {
    const auto byte = [&](std::size_t i) { return std::size_t{static_cast<std::uint8_t>(message[at + i])}; };
    kinds.push_back(static_cast<int>(byte(0)));
    const bool is_little_endian = (byte(1) & 1) != 0;
    at += 4 + (is_little_endian ? byte(2) | byte(3) << 8 : byte(3) | byte(2) << 8);
  }
  if (at != message.size()) {
    kinds.push_back(0);
  }
  return kinds;
}

TEST(SharedMemory, WhatFastDdsAnnouncesHasNothingBehindIt) {
  fdds::DomainParticipantQos qos;
  const auto traffic = std::make_shared<DiscoveryTraffic>();
  traffic->introduce({});
  rmw_fastrtps::use_default_transports({}, 0, traffic, qos);
  ASSERT_EQ(qos.transport().user_transports.size(), 2U);
  const auto shared_memory = qos.transport().user_transports.back();
  qos.transport().user_transports = {shared_memory};

  const std::unique_ptr<rtps::TransportInterface> transport(shared_memory->create_transport());
  ASSERT_TRUE(transport->init());
  const rtps::Locator_t here = own_port();
  Arrived arrived;
  ASSERT_TRUE(transport->OpenInputChannel(here, &arrived, kLargestMessage));
  qos.wire_protocol().builtin.initialPeersList.push_back(here);
  auto& factory = *fdds::DomainParticipantFactory::get_instance();
  constexpr std::uint32_t kDomains = 200;
  fdds::DomainParticipant* participant =
      factory.create_participant(static_cast<std::uint32_t>(::getpid()) % kDomains, qos);
  ASSERT_TRUE(participant);
  const std::optional<std::string> announcement = arrived.next();
  EXPECT_EQ(factory.delete_participant(participant), rmw_fastrtps::return_code::kOk);
  ASSERT_TRUE(announcement);
  constexpr int kTimestamp = 0x09;
  constexpr int kData = 0x15;
  EXPECT_THAT(submessages(*announcement), ElementsAre(kTimestamp, kData));
  EXPECT_TRUE(transport->CloseInputChannel(here));
  transport->shutdown();
}

std::string announcement_of_a_participant() {
  constexpr char kBytes[] =
      "RTPS\2\3\1\17\0\0\0\0\0\0\0\0\0\0\0\2"                            // of participant 2
      "\x15\5\30\0\0\0\20\0\0\0\0\0\0\1\0\xc2\0\0\0\0\1\0\0\0\0\3\0\0";  // data: first sample
  return {kBytes, sizeof kBytes - 1};
}

// Processes that open a port at once may remove each other's file of it. Then nobody writes where the reader reads.
TEST(SharedMemory, APortThatIsTakenAwayIsOpenedAgain) {
  NEEDS_NETWORK_DEVICES();
  fdds::DomainParticipantQos qos;
  const auto traffic = std::make_shared<DiscoveryTraffic>();
  traffic->introduce({});
  rmw_fastrtps::use_default_transports({}, 0, traffic, qos);
  ASSERT_EQ(qos.transport().user_transports.size(), 2U);
  const std::unique_ptr<rtps::TransportInterface> udp(qos.transport().user_transports.front()->create_transport());
  const std::unique_ptr<rtps::TransportInterface> reader(qos.transport().user_transports.back()->create_transport());
  ASSERT_TRUE(udp->init() && reader->init());
  const rtps::Locator_t here = own_port();
  Arrived arrived;
  ASSERT_TRUE(reader->OpenInputChannel(here, &arrived, kLargestMessage));
  rtps::Locator_t network(LOCATOR_KIND_UDPv4, 20'000 + static_cast<std::uint32_t>(::getpid()) % 10'000);
  rtps::IPLocator::setIPv4(network, "127.0.0.1");
  Arrived announcements;
  ASSERT_TRUE(udp->OpenInputChannel(network, &announcements, kLargestMessage));
  ASSERT_EQ(::unlink(rmw_fastrtps::shared_memory_port_file(here.port).c_str()), 0);

  // Others find no port, and make one, which they alone know.
  const std::unique_ptr<rtps::TransportInterface> others(rtps::SharedMemTransportDescriptor().create_transport());
  const std::unique_ptr<rtps::TransportInterface> udp_of_others(rtps::UDPv4TransportDescriptor().create_transport());
  ASSERT_TRUE(others->init() && udp_of_others->init());
  rtps::SendResourceList senders;
  rtps::Locator_t there = here;
  there.port = rmw_fastrtps::shared_memory_file_number(here.port);
  ASSERT_TRUE(others->OpenOutputChannel(senders, there));
  ASSERT_TRUE(udp_of_others->OpenOutputChannel(senders, network));
  ASSERT_GE(senders.size(), 2U);
  const std::string announcement = announcement_of_a_participant();
  constexpr int kTries = 40;
  int tries = 0;
  for (; tries < kTries && !arrived.next(std::chrono::milliseconds(250)); ++tries) {
    send(*senders.front(), there, {"found"});
    send(*senders[1], network, {announcement});
  }
  EXPECT_LT(tries, kTries);
  senders.clear();
  EXPECT_TRUE(reader->CloseInputChannel(here));
  EXPECT_TRUE(udp->CloseInputChannel(network));
}

TEST(SharedMemory, AMessageEndsWhereItEndsWithTheTransportsOfAProfile) {
  fdds::DomainParticipantQos qos;
  auto of_profile = std::make_shared<rtps::SharedMemTransportDescriptor>();
  of_profile->segment_size(1 << 20);
  of_profile->max_message_size(kLargestMessage);
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = {of_profile};
  rmw_fastrtps::forward_shared_memory(qos);
  ASSERT_EQ(qos.transport().user_transports.size(), 1U);
  const auto used = std::dynamic_pointer_cast<rtps::SharedMemTransportDescriptor>(qos.transport().user_transports[0]);
  ASSERT_TRUE(used);
  EXPECT_EQ(used->segment_size(), 1U << 20);
  EXPECT_EQ(used->max_message_size(), kLargestMessage);
  expect_whole_messages(*used);
}

// Here the profile has sizes of buffers only.
TEST(SharedMemory, AMessageEndsWhereItEndsWithTheBuffersOfAProfile) {
  fdds::DomainParticipantQos qos;
  qos.transport().send_socket_buffer_size = 300'000;
  rmw_fastrtps::forward_shared_memory(qos);
  ASSERT_FALSE(qos.transport().use_builtin_transports);
  bool has_udp = false;
  bool has_shared_memory = false;
  for (const auto& descriptor : qos.transport().user_transports) {
    if (const auto* udp = dynamic_cast<rtps::UDPv4TransportDescriptor*>(descriptor.get())) {
      EXPECT_EQ(udp->sendBufferSize, 300'000U);
      has_udp = true;
    } else {
      EXPECT_TRUE(dynamic_cast<rtps::SharedMemTransportDescriptor*>(descriptor.get()));
      expect_whole_messages(*descriptor);
      has_shared_memory = true;
    }
  }
  EXPECT_TRUE(has_udp && has_shared_memory);
}

}  // namespace
