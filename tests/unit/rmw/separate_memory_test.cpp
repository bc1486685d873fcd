// SPDX-License-Identifier: Apache-2.0
// Releases of Fast DDS whose shared memory differs keep out of each other's.
#include "fastdds_versions/separate_memory.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <fstream>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "fastdds_versions/transport.hpp"
#include "participant/default_transports.hpp"
#include "rmw_test.hpp"
#include "tests/support/emulated.hpp"

namespace {

using rmw_fastrtps::announced_hosts;
using rmw_fastrtps::DiscoveryTraffic;
using testing::Each;
using testing::ElementsAre;
using testing::Gt;
using testing::IsEmpty;
using testing::Not;
namespace fdds = eprosima::fastdds::dds;
namespace rtps = rmw_fastrtps::rtps;

// Bytes of announcements.
class Message {
 public:
  Message() { add("RTPS\2\3\1\17\0\0\0\0\0\0\0\0\0\0\0\2"); }

  template <std::size_t size>
  Message& add(const char (&bytes)[size]) {
    bytes_.append(bytes, size - 1);
    return *this;
  }
  // Data of this writer of announcements, with its first sample. To be followed by parameters.
  Message& data(const std::string& writer, bool with_inline_qos = false) {
    submessage_ = bytes_.size();
    bytes_ += std::string("\x15\0\0\0", 4) + std::string("\0\0\20\0\0\0\0\0", 8) + writer;
    bytes_ += std::string("\0\0\0\0\1\0\0\0", 8);
    bytes_[submessage_ + 1] = with_inline_qos ? 7 : 5;
    if (with_inline_qos) {
      add("\x70\0\4\0qos.\1\0\0\0");
    }
    return add("\0\3\0\0");
  }
  Message& locator(char parameter, char kind, char host) {
    bytes_ += std::string{parameter, 0, 24, 0, kind, 0, 0, 0, 1, 2, 3, 4, 'U'};
    places_.push_back(bytes_.size());
    bytes_ += std::string{host, host} + std::string(13, '\0');
    return *this;
  }
  Message& end() {
    add("\1\0\0\0");
    bytes_[submessage_ + 2] = static_cast<char>(bytes_.size() - submessage_ - 4);
    return *this;
  }

  const std::string& bytes() const { return bytes_; }
  const std::vector<std::size_t>& places() const { return places_; }  // of the hosts
  std::vector<std::size_t> found() const {
    return announced_hosts({reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size()});
  }

 private:
  std::string bytes_;
  std::size_t submessage_ = 0;
  std::vector<std::size_t> places_;
};

const std::string kParticipants("\0\1\0\xc2", 4);
const std::string kPublications("\0\0\3\xc2", 4);
constexpr char kDefaultUnicast = 0x31;
constexpr char kUnicast = 0x2f;
constexpr char kSharedMemory = LOCATOR_KIND_SHM;  // has the number of the major version in it

TEST(AnnouncedHosts, AreThoseOfSharedMemoryInEachAnnouncement) {
  Message message;
  message.data(std::string("\0\0\1\3", 4)).end();  // of an application
  message.data(kParticipants)
      .locator(kDefaultUnicast, LOCATOR_KIND_UDPv4, 1)
      .locator(kDefaultUnicast, kSharedMemory, 2)
      .end();
  message.add("\x09\1\10\0timetime").add("\x09\3\0\0");  // the second one: no time
  message.data(kPublications, true).locator(kUnicast, kSharedMemory, 3).locator(0x50, kSharedMemory, 4).end();
  EXPECT_THAT(message.found(), ElementsAre(message.places()[1], message.places()[2]));
}

TEST(AnnouncedHosts, OfAMessageThatEndsAnywhereAreInIt) {
  Message message;
  message.data(kParticipants, true).locator(kDefaultUnicast, kSharedMemory, 2).end();
  ASSERT_EQ(message.found().size(), 1U);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(message.bytes().data());
  for (std::size_t size = 0; size < message.bytes().size(); ++size) {
    const std::vector<std::uint8_t> part(bytes, bytes + size);  // its end is found by the address sanitizer
    for (const std::size_t place : announced_hosts(part)) {
      EXPECT_LT(place + 1, size);
    }
  }
}

class Arrived final : public rtps::TransportReceiverInterface {
 public:
  void OnDataReceived(const rtps::octet* data, std::uint32_t size, const rtps::Locator_t&,
                      const rtps::Locator_t&) override {
    const std::lock_guard lock(mutex_);
    message_.assign(reinterpret_cast<const char*>(data), size);
    changed_.notify_all();
  }
  std::string wait() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(30), [this] { return !message_.empty(); });
    return message_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string message_;
};

#if RMW_FASTDDS_HAS_MEMORY_OF_ITS_OWN

std::string sent_between(const rtps::TransportDescriptorInterface& sender,
                         const rtps::TransportDescriptorInterface& receiver, const std::string& message) {
  const std::unique_ptr<rtps::TransportInterface> from(sender.create_transport());
  const std::unique_ptr<rtps::TransportInterface> to(receiver.create_transport());
  EXPECT_TRUE(from->init() && to->init());
  rtps::Locator_t port(LOCATOR_KIND_UDPv4, 20'000 + static_cast<std::uint32_t>(::getpid()) % 10'000);
  rtps::IPLocator::setIPv4(port, "127.0.0.1");
  Arrived arrived;
  EXPECT_TRUE(to->OpenInputChannel(port, &arrived, 65500));
  rtps::SendResourceList senders;
  EXPECT_TRUE(from->OpenOutputChannel(senders, port));
  const std::vector<rtps::Locator_t> destinations{port};
  for (auto& one : senders) {
    rtps::Locators begin(destinations.begin());
    rtps::Locators end(destinations.end());
    one->send(reinterpret_cast<const rtps::octet*>(message.data()), static_cast<std::uint32_t>(message.size()), &begin,
              &end, std::chrono::steady_clock::now() + std::chrono::seconds(30));
  }
  std::string found = arrived.wait();
  senders.clear();
  EXPECT_TRUE(to->CloseInputChannel(port));
  return found;
}

// One that has heard nothing yet.
std::shared_ptr<rtps::TransportDescriptorInterface> our_udp() {
  fdds::DomainParticipantQos qos;
  const auto traffic = std::make_shared<DiscoveryTraffic>();
  traffic->introduce({});
  rmw_fastrtps::use_default_transports({}, 0, traffic, qos);
  return qos.transport().user_transports.front();
}

// Whoever takes a locator of shared memory for one of this host opens its port.
TEST(SeparateMemory, IsOfAnotherHostForAllThatAreNotOfThisStack) {
  NEEDS_NETWORK_DEVICES();
  const rtps::UDPv4TransportDescriptor theirs;
  Message message;
  message.data(kParticipants).locator(kDefaultUnicast, kSharedMemory, 2).end();
  std::string changed = message.bytes();
  changed[message.places()[0]] ^= 0x29;
  changed[message.places()[0] + 1] = static_cast<char>(changed[message.places()[0] + 1] ^ 0x91);
  EXPECT_EQ(sent_between(*our_udp(), *our_udp(), message.bytes()), message.bytes());
  EXPECT_EQ(sent_between(*our_udp(), theirs, message.bytes()), changed);
  EXPECT_EQ(sent_between(theirs, *our_udp(), message.bytes()), changed);
}

// The ports in shared memory that this process has opened.
std::set<std::uint64_t> open_ports() {
  std::set<std::uint64_t> ports;
  std::ifstream maps("/proc/self/maps");
  constexpr std::string_view kPort = "/dev/shm/fastrtps_port";
  for (std::string line; std::getline(maps, line);) {
    if (const std::size_t at = line.find(kPort); at != std::string::npos) {
      ports.insert(std::stoull(line.substr(at + kPort.size())));
    }
  }
  return ports;
}

// The port of the domain's multicast is one that every process of a release 2 opens when it starts.
TEST(SeparateMemory, HasNoPortThatAnotherReleaseOpens) {
  rmw_test::Context context;
  const rmw_test::Node node(context);
  EXPECT_THAT(open_ports(), Not(IsEmpty()));
  EXPECT_THAT(open_ports(), Each(Gt(0x80000000U)));
}

#endif

}  // namespace
