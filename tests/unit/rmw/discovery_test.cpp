// SPDX-License-Identifier: Apache-2.0
// The additions of rmw to Fast DDS's discovery.
#include <gmock/gmock.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "fastdds_versions/transport.hpp"
#include "participant/default_transports.hpp"
#include "participant/shared_memory_ports.hpp"
#include "participant/unanswered_participants.hpp"

namespace {

using rmw_fastrtps::choose_shared_memory_ports;
using rmw_fastrtps::DiscoveryTraffic;
using rmw_fastrtps::Gid;
using rmw_fastrtps::UnansweredParticipants;
using testing::ElementsAre;
using testing::IsEmpty;
namespace fdds = eprosima::fastdds::dds;
namespace rtps = rmw_fastrtps::rtps;
namespace transports = eprosima::fastdds::rtps;

using Time = UnansweredParticipants::TimePoint;
constexpr Time kStart{};
constexpr auto kPatience = UnansweredParticipants::kPatience;

Gid gid(std::uint8_t participant, std::uint8_t entity) {
  Gid gid{};
  gid[11] = participant;
  gid[15] = entity;
  return gid;
}

TEST(UnansweredParticipants, WhoStaysSilentIsToldFiveTimesEverMorePatiently) {
  UnansweredParticipants unanswered;
  EXPECT_EQ(unanswered.next(), std::nullopt);
  unanswered.discovered(gid(1, 0), kStart);
  EXPECT_TRUE(unanswered.changed().is_ready());
  ASSERT_EQ(unanswered.next(), kStart + kPatience);
  EXPECT_THAT(unanswered.take_due(kStart + kPatience - std::chrono::nanoseconds(1)), IsEmpty());
  EXPECT_THAT(unanswered.take_due(kStart + kPatience), ElementsAre(gid(1, 0)));
  EXPECT_THAT(unanswered.take_due(kStart + kPatience), IsEmpty());
  for (const int time : {3, 7, 15, 31}) {
    ASSERT_EQ(unanswered.next(), kStart + time * kPatience);
    EXPECT_THAT(unanswered.take_due(kStart + time * kPatience), ElementsAre(gid(1, 0)));
  }
  EXPECT_EQ(unanswered.next(), std::nullopt);
  EXPECT_THAT(unanswered.take_due(kStart + 100 * kPatience), IsEmpty());
}

TEST(UnansweredParticipants, WhoAreSilentAreToldTogether) {
  UnansweredParticipants unanswered;
  unanswered.discovered(gid(1, 0), kStart);
  unanswered.discovered(gid(2, 0), kStart + kPatience / 2);
  EXPECT_THAT(unanswered.take_due(kStart + 2 * kPatience), ElementsAre(gid(1, 0), gid(2, 0)));
  EXPECT_THAT(unanswered.take_due(kStart + 2 * kPatience), IsEmpty());
  EXPECT_EQ(unanswered.next(), kStart + 4 * kPatience);
}

TEST(UnansweredParticipants, AnEndpointOfAParticipantIsItsAnswer) {
  UnansweredParticipants unanswered;
  unanswered.discovered(gid(1, 0), kStart);
  unanswered.discovered(gid(2, 0), kStart + kPatience);
  unanswered.settled(gid(1, 7));
  EXPECT_EQ(unanswered.next(), kStart + 2 * kPatience);
  unanswered.settled(gid(2, 0));
  EXPECT_EQ(unanswered.next(), std::nullopt);
}

class SharedMemoryPorts : public testing::Test {
 protected:
  SharedMemoryPorts() {
    prefix_.value[2] = 0x7f;
    prefix_.value[3] = 0x01;
  }

  // The only one of its kind.
  static rtps::Locator_t shared_memory(const rtps::LocatorList_t& locators) {
    rtps::Locator_t found;
    for (const rtps::Locator_t& locator : locators) {
      if (locator.kind == LOCATOR_KIND_SHM) {
        EXPECT_NE(found.kind, LOCATOR_KIND_SHM);
        found = locator;
      }
    }
    EXPECT_EQ(found.kind, LOCATOR_KIND_SHM);
    return found;
  }

  rtps::GuidPrefix_t prefix_;
};

TEST_F(SharedMemoryPorts, AreNewForEveryParticipantAndOfThisHost) {
  fdds::DomainParticipantQos first;
  fdds::DomainParticipantQos second;
  choose_shared_memory_ports(3, prefix_, first);
  choose_shared_memory_ports(3, prefix_, second);
  std::set<std::uint32_t> ports;
  for (const auto* qos : {&first, &second}) {
    const auto& wire = qos->wire_protocol();
    for (const auto* locators : {&wire.builtin.metatrafficUnicastLocatorList, &wire.default_unicast_locator_list}) {
      const rtps::Locator_t locator = shared_memory(*locators);
      EXPECT_THAT(std::vector<int>(locator.address, locator.address + 3), ElementsAre('U', 0x7f, 0x01));
      EXPECT_GT(locator.port, 0xffffU);
      ports.insert(locator.port);
    }
  }
  EXPECT_EQ(ports.size(), 4U);
}

TEST_F(SharedMemoryPorts, LeaveTheWellKnownOnesOfUdpAndMulticast) {
  fdds::DomainParticipantQos qos;
  choose_shared_memory_ports(3, prefix_, qos);
  const auto& wire = qos.wire_protocol();
  // Port 0 stands for a port that Fast DDS chooses.
  EXPECT_EQ(*wire.builtin.metatrafficUnicastLocatorList.begin(), rtps::Locator_t());
  EXPECT_EQ(*wire.default_unicast_locator_list.begin(), rtps::Locator_t());
  constexpr std::uint32_t kMulticastOfDomain3 = 7400 + 3 * 250;
  EXPECT_EQ(wire.builtin.metatrafficMulticastLocatorList.size(), 2U);
  for (const rtps::Locator_t& locator : wire.builtin.metatrafficMulticastLocatorList) {
    EXPECT_EQ(locator.port, kMulticastOfDomain3);
  }
  EXPECT_EQ(shared_memory(wire.builtin.metatrafficMulticastLocatorList).address[0], 'M');
}

TEST_F(SharedMemoryPorts, LeaveTheLocatorsOfAProfile) {
  fdds::DomainParticipantQos qos;
  const rtps::Locator_t mine(9000);
  qos.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(mine);
  qos.wire_protocol().default_multicast_locator_list.push_back(mine);
  const fdds::DomainParticipantQos before = qos;
  choose_shared_memory_ports(0, prefix_, qos);
  EXPECT_TRUE(qos == before);
}

TEST(DefaultTransports, AreUdpAndSharedMemoryThatReportALargerSendBuffer) {
  fdds::DomainParticipantQos qos;
  rmw_fastrtps::use_default_transports({}, 0, std::make_shared<DiscoveryTraffic>(), qos);
  EXPECT_FALSE(qos.transport().use_builtin_transports);
  std::vector<int> kinds;
  for (const auto& descriptor : qos.transport().user_transports) {
    const std::unique_ptr<transports::TransportInterface> transport(descriptor->create_transport());
    ASSERT_TRUE(transport->init());
    kinds.push_back(transport->kind());
    const auto& configuration = *transport->get_configuration();
    EXPECT_EQ(configuration.min_send_buffer_size(), rmw_fastrtps::kBytesBetweenHeartbeats);
    EXPECT_EQ(configuration.max_message_size(), 65500U) << "as Fast DDS has it for both";
    EXPECT_EQ(configuration.max_initial_peers_range(), 4U);
    transport->shutdown();
  }
  EXPECT_THAT(kinds, ElementsAre(LOCATOR_KIND_UDPv4, LOCATOR_KIND_SHM));
}

// Whether messages may be sent to the locator. Fast DDS 2.12 asks with two more arguments.
template <typename Transport>
bool may_reach(const Transport& transport, const rtps::Locator_t& locator) {
  rtps::Locator_t reached;
  if constexpr (requires { transport.transform_remote_locator(locator, reached, true, true); }) {
    return transport.transform_remote_locator(locator, reached, true, true) && reached.port == locator.port;
  } else {
    return transport.transform_remote_locator(locator, reached) && reached.port == locator.port;
  }
}

// A program with the other major version of Fast DDS on this host has its ports under other names. Version 2 takes the
// locator for one of its own, and what it writes there is lost. Version 3 looks for the port (is_locator_reachable).
TEST(DefaultTransports, DoNotBelieveInAPortOfSharedMemoryThatIsNotThere) {
  fdds::DomainParticipantQos qos;
  rmw_fastrtps::use_default_transports({}, 0, std::make_shared<DiscoveryTraffic>(), qos);
  const std::unique_ptr<rtps::TransportInterface> transport(qos.transport().user_transports.back()->create_transport());
  ASSERT_TRUE(transport->init());
  EXPECT_FALSE(may_reach(*transport, rtps::Locator_t(LOCATOR_KIND_SHM, 0x7ffffff7)));
  const rtps::Locator_t there(LOCATOR_KIND_SHM, 0x7ffffff5);
  const std::string file = rmw_fastrtps::shared_memory_port_file(there.port);
  std::ofstream(file).put(' ');
  if (RMW_FASTDDS_MAJOR < 3) {  // version 3 also looks whether the port is one
    EXPECT_TRUE(may_reach(*transport, there));
  }
  std::filesystem::remove(file);
  transport->shutdown();
}

TEST(DefaultTransports, TellWhetherSharedMemoryHasRoom) {
  EXPECT_TRUE(rmw_fastrtps::has_room_in_shared_memory(0));
  EXPECT_FALSE(rmw_fastrtps::has_room_in_shared_memory(std::numeric_limits<std::uint64_t>::max()));
}

TEST(DefaultTransports, ReachAsManyLocalPeersAsAskedFor) {
  fdds::DomainParticipantQos qos;
  rmw_fastrtps::use_default_transports({}, 32, std::make_shared<DiscoveryTraffic>(), qos);
  EXPECT_EQ(qos.transport().user_transports.front()->max_initial_peers_range(), 32U);
}

TEST(DefaultTransports, LeaveTheTransportsAndBuffersOfAProfile) {
  fdds::DomainParticipantQos qos;
  EXPECT_TRUE(rmw_fastrtps::has_default_transports(qos));
  qos.transport().listen_socket_buffer_size = 1 << 20;
  EXPECT_FALSE(rmw_fastrtps::has_default_transports(qos));
  qos = {};
  qos.transport().send_socket_buffer_size = 1 << 20;
  EXPECT_FALSE(rmw_fastrtps::has_default_transports(qos));
  qos = {};
  rmw_fastrtps::use_default_transports({}, 0, std::make_shared<DiscoveryTraffic>(), qos);
  EXPECT_FALSE(rmw_fastrtps::has_default_transports(qos));
  qos = {};
  qos.transport().use_builtin_transports = false;
  EXPECT_FALSE(rmw_fastrtps::has_default_transports(qos));
}

}  // namespace
