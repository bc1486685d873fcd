// SPDX-License-Identifier: Apache-2.0
// Which messages of discovery pass between Fast DDS and its transports.
#include "participant/discovery_traffic.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <initializer_list>
#include <thread>
#include <vector>

#include "participant/discovery_message.hpp"

namespace {

using rmw_fastrtps::discovery_message_in;
using rmw_fastrtps::DiscoveryMessage;
using rmw_fastrtps::DiscoveryTraffic;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

using Bytes = std::vector<std::uint8_t>;
using Kind = DiscoveryMessage::Kind;
using Locator = DiscoveryTraffic::Locator;
using GuidPrefix = DiscoveryTraffic::GuidPrefix;

constexpr DiscoveryTraffic::TimePoint kStart{seconds(1000)};
constexpr auto kLease = seconds(20);
constexpr std::uint8_t kSelf = 1;
constexpr std::uint8_t kOther = 2;
constexpr std::uint8_t kThird = 3;

GuidPrefix prefix(std::uint8_t participant) {
  GuidPrefix prefix;
  prefix.value[11] = participant;
  return prefix;
}

Locator udp(std::uint32_t port) {
  return Locator(LOCATOR_KIND_UDPv4, port);
}
Locator shared_memory(std::uint32_t port) {
  return Locator(LOCATOR_KIND_SHM, port);
}

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Bytes message_of(std::uint8_t participant, const Bytes& submessages) {
  return Bytes{'R', 'T', 'P', 'S', 2, 3, 1, 15, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, participant} + submessages;
}

const Bytes kTimestamp = {0x09, 0x01, 8, 0, 1, 2, 3, 4, 5, 6, 7, 8};
Bytes to(std::uint8_t participant) {
  return {0x0e, 0x01, 12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, participant};
}

// Data of the writer with this last but one byte, as in RTPS 9.4.5.3; only as much as is read.
Bytes data(std::uint8_t flags, std::initializer_list<std::uint8_t> writer, std::uint8_t number) {
  return Bytes{0x15, flags, 24, 0, 0, 0, 16, 0, 0, 0, 0, 0} + Bytes(writer) +
         Bytes{0, 0, 0, 0, number, 0, 0, 0, 0, 3, 0, 0};
}
Bytes announcement(std::uint8_t participant, std::uint8_t number) {
  return message_of(participant, kTimestamp + data(0x05, {0, 1, 0, 0xc2}, number));
}
Bytes end_of_endpoint() {
  return message_of(kSelf, kTimestamp + data(0x03, {0, 0, 3, 0xc2}, 9));
}
Bytes heartbeat(std::uint8_t writer, std::uint8_t last_number, std::uint8_t count) {
  return message_of(kSelf, Bytes{0x07, 0x01, 28, 0, 0, 0, 0, 0, 0,           0, writer, 0xc2, 0,     0, 0, 0,
                                 1,    0,    0,  0, 0, 0, 0, 0, last_number, 0, 0,      0,    count, 0, 0, 0});
}
Bytes question(std::uint8_t participant, std::uint8_t reader, std::uint8_t count, std::uint8_t flags = 0x01) {
  return message_of(kSelf, to(participant) + Bytes{0x06, flags, 24, 0, 0, 0, 0, reader, 0, 0, 3,     0xc2, 0, 0,
                                                   0,    0,     0,  0, 0, 0, 0, 0,      0, 0, count, 0,    0, 0});
}

TEST(DiscoveryMessage, IsAnAnnouncementWithSenderAndNumber) {
  const auto message = discovery_message_in(announcement(kOther, 7));
  ASSERT_TRUE(message.has_value());
  EXPECT_EQ(message->kind, Kind::kAnnouncement);
  EXPECT_EQ(message->sender, prefix(kOther));
  EXPECT_EQ(message->sequence_number, 7);
}

TEST(DiscoveryMessage, IsReadInBothOrdersOfBytes) {
  const Bytes big_endian = {0x15, 0x04, 0, 24, 0, 0, 0,    16, 0, 0, 0, 0, 0, 1, 0, 0xc2,
                            0,    0,    0, 1,  0, 0, 0x01, 0,  0, 3, 0, 0, 0, 0, 0, 0};
  const auto message = discovery_message_in(message_of(kOther, Bytes{0x09, 0x00, 0, 0} + big_endian));
  ASSERT_TRUE(message.has_value());
  EXPECT_EQ(message->sequence_number, (std::int64_t{1} << 32) + 256);
}

TEST(DiscoveryMessage, IsAHeartbeatOfAWriterOfEndpoints) {
  const auto message = discovery_message_in(heartbeat(4, 20, 6));
  ASSERT_TRUE(message.has_value());
  EXPECT_EQ(message->kind, Kind::kHeartbeat);
  EXPECT_EQ(message->writer, 0x000004c2U);
  EXPECT_EQ(message->sequence_number, 20);
  EXPECT_EQ(message->count, 6U);
}

TEST(DiscoveryMessage, IsTheQuestionOfAReader) {
  const auto message = discovery_message_in(question(kOther, 5, 8));
  ASSERT_TRUE(message.has_value());
  EXPECT_EQ(message->kind, Kind::kQuestion);
  EXPECT_EQ(message->receiver, prefix(kOther));
  EXPECT_EQ(message->reader, 0x00000005U);
  EXPECT_EQ(message->writer, 0x000003c2U);
  EXPECT_EQ(message->count, 8U);
}

TEST(DiscoveryMessage, IsTheEndOfAnEndpoint) {
  const auto message = discovery_message_in(end_of_endpoint());
  ASSERT_TRUE(message.has_value());
  EXPECT_EQ(message->kind, Kind::kEndOfEndpoint);
}

TEST(DiscoveryMessage, IsNothingElse) {
  constexpr std::uint8_t kFinal = 0x03;
  EXPECT_EQ(discovery_message_in(question(kOther, 5, 8, kFinal)), std::nullopt) << "an acknowledgement";
  EXPECT_EQ(discovery_message_in(message_of(kSelf, data(0x03, {0, 1, 0, 0xc2}, 1))), std::nullopt)
      << "the end of a participant";
  EXPECT_EQ(discovery_message_in(message_of(kSelf, data(0x05, {0, 0, 3, 0xc2}, 1))), std::nullopt) << "an endpoint";
  EXPECT_EQ(discovery_message_in(message_of(kSelf, data(0x05, {0, 0, 1, 3}, 1))), std::nullopt) << "a user's message";
  EXPECT_EQ(discovery_message_in(heartbeat(2, 1, 1)), std::nullopt) << "another writer's heartbeat";
}

TEST(DiscoveryMessage, MayEndAnywhere) {
  for (const Bytes& whole :
       {announcement(kOther, 1), heartbeat(3, 1, 1), question(kOther, 1, 1), message_of(kSelf, kTimestamp)}) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      (void)discovery_message_in(part);
    }
    EXPECT_EQ(discovery_message_in(Bytes(whole.begin(), whole.begin() + 30)), std::nullopt);
  }
}

class Traffic : public testing::Test {
 protected:
  bool hears(const Bytes& message, milliseconds at = {}) {
    return traffic_.is_heard(*discovery_message_in(message), LOCATOR_KIND_UDPv4, kStart + at);
  }
  std::vector<Locator> sent(const Bytes& message, std::vector<Locator> destinations, milliseconds at = {}) {
    traffic_.restrict(*discovery_message_in(message), destinations, kStart + at);
    return destinations;
  }
  // In a thread of its own, as the threads of Fast DDS that receive.
  template <typename Function>
  void in_a_thread(Function function) {
    std::thread(function).join();
  }

  DiscoveryTraffic traffic_;
};

class IntroducedTraffic : public Traffic {
 protected:
  IntroducedTraffic() { traffic_.introduce(prefix(kSelf)); }
};

TEST_F(Traffic, IsIntroducedOnce) {
  EXPECT_FALSE(traffic_.is_introduced());
  traffic_.introduce(prefix(kSelf));
  EXPECT_TRUE(traffic_.is_introduced());
}

TEST_F(IntroducedTraffic, DoesNotHearItself) {
  EXPECT_FALSE(hears(announcement(kSelf, 1)));
  EXPECT_TRUE(hears(end_of_endpoint())) << "anything but announcements passes";
}

TEST_F(IntroducedTraffic, HearsTheSameOnceInAMoment) {
  EXPECT_TRUE(hears(announcement(kOther, 1)));
  EXPECT_FALSE(hears(announcement(kOther, 1)));
  EXPECT_TRUE(hears(announcement(kThird, 1)));
  EXPECT_TRUE(hears(announcement(kOther, 2))) << "something new";
  EXPECT_FALSE(hears(announcement(kOther, 2), milliseconds(49)));
  EXPECT_TRUE(hears(announcement(kOther, 2), milliseconds(50)));
}

TEST_F(IntroducedTraffic, HearsOftenEnoughForTheLease) {
  in_a_thread([&] {
    hears(announcement(kOther, 1));
    traffic_.discovered(prefix(kOther), {}, kLease);
    hears(announcement(kThird, 1));
    traffic_.discovered(prefix(kThird), {}, milliseconds(400));
  });
  EXPECT_FALSE(hears(announcement(kOther, 1), milliseconds(999)));
  EXPECT_TRUE(hears(announcement(kOther, 1), milliseconds(1000)));
  EXPECT_FALSE(hears(announcement(kThird, 1), milliseconds(99)));
  EXPECT_TRUE(hears(announcement(kThird, 1), milliseconds(100)));
}

TEST_F(IntroducedTraffic, ForgetsWhoIsGone) {
  EXPECT_TRUE(hears(announcement(kOther, 1)));
  traffic_.gone(prefix(kOther));
  EXPECT_TRUE(hears(announcement(kOther, 1)));
}

TEST_F(IntroducedTraffic, AnswersTheNewcomerOnly) {
  const std::vector<Locator> all = {udp(7400), shared_memory(1), shared_memory(2)};
  in_a_thread([&] {
    EXPECT_EQ(sent(announcement(kSelf, 1), all), all) << "nobody discovered yet";
    traffic_.discovered(prefix(kOther), {shared_memory(1)}, kLease);
    EXPECT_THAT(sent(announcement(kSelf, 1), all), ElementsAre(shared_memory(1)));
    traffic_.discovered(prefix(kThird), {shared_memory(2)}, kLease);
    EXPECT_THAT(sent(announcement(kSelf, 1), all), ElementsAre(shared_memory(2)));
    EXPECT_THAT(sent(heartbeat(3, 1, 1), all), SizeIs(3)) << "this is for announcements only";
    traffic_.discovered(prefix(kThird), {}, kLease);
    EXPECT_EQ(sent(announcement(kSelf, 1), all), all) << "it has named no locators";
  });
  EXPECT_EQ(sent(announcement(kSelf, 1), all), all) << "another thread announces to all";
}

TEST_F(IntroducedTraffic, AnnouncesAgainToSome) {
  in_a_thread([&] {
    hears(announcement(kOther, 1));
    traffic_.discovered(prefix(kOther), {shared_memory(1)}, kLease);
  });
  const std::vector<Locator> all = {udp(7400), shared_memory(1), shared_memory(2)};
  {
    const DiscoveryTraffic::OnlyTo only(traffic_, {prefix(kOther)});
    EXPECT_THAT(sent(announcement(kSelf, 1), all), ElementsAre(shared_memory(1)));
  }
  EXPECT_EQ(sent(announcement(kSelf, 1), all), all);
}

TEST_F(IntroducedTraffic, LeavesOutSharedMemoryWhereMulticastReachesIt) {
  const std::vector<Locator> all = {udp(7400), shared_memory(7400), shared_memory(1)};
  EXPECT_FALSE(traffic_.is_heard(*discovery_message_in(announcement(kSelf, 1)), LOCATOR_KIND_SHM, kStart));
  EXPECT_EQ(sent(announcement(kSelf, 1), all), all) << "its own announcement came back by shared memory only";
  EXPECT_FALSE(hears(announcement(kSelf, 1)));
  EXPECT_THAT(sent(announcement(kSelf, 1), all), ElementsAre(udp(7400)));
  in_a_thread([&] {
    traffic_.discovered(prefix(kOther), {shared_memory(1)}, kLease);
    EXPECT_THAT(sent(announcement(kSelf, 1), all), ElementsAre(shared_memory(1))) << "answers still go there";
  });
}

TEST_F(IntroducedTraffic, AsksAllReadersNowAndThen) {
  const std::vector<Locator> all = {shared_memory(1), shared_memory(2)};
  EXPECT_EQ(sent(heartbeat(3, 5, 1), all), all);
  EXPECT_EQ(sent(heartbeat(3, 5, 1), all), all) << "the same one by another transport";
  EXPECT_THAT(sent(heartbeat(3, 5, 2), all), IsEmpty());
  EXPECT_THAT(sent(heartbeat(3, 5, 2), {shared_memory(1)}), SizeIs(1)) << "one reader may be asked at any time";
  EXPECT_EQ(sent(heartbeat(4, 5, 2), all), all) << "another writer";
  EXPECT_EQ(sent(heartbeat(3, 6, 3), all), all) << "another sample";
  EXPECT_THAT(sent(heartbeat(3, 6, 4), all, milliseconds(499)), IsEmpty());
  EXPECT_EQ(sent(heartbeat(3, 6, 5), all, milliseconds(500)), all);
}

TEST_F(IntroducedTraffic, AsksAWriterEverMorePatiently) {
  const std::vector<Locator> writer = {shared_memory(1)};
  EXPECT_EQ(sent(question(kOther, 1, 1), writer), writer);
  EXPECT_EQ(sent(question(kOther, 1, 1), writer), writer) << "the same one by another transport";
  EXPECT_THAT(sent(question(kOther, 1, 2), writer, milliseconds(149)), IsEmpty());
  EXPECT_EQ(sent(question(kOther, 2, 2), writer), writer) << "another reader";
  EXPECT_EQ(sent(question(kThird, 1, 2), writer), writer) << "another participant";
  std::uint8_t count = 3;
  int at = 0;
  for (const int patience : {150, 300, 600, 1000, 1000}) {
    EXPECT_THAT(sent(question(kOther, 1, count++), writer, milliseconds(at + patience - 1)), IsEmpty());
    at += patience;
    EXPECT_EQ(sent(question(kOther, 1, count++), writer, milliseconds(at)), writer);
  }
  traffic_.gone(prefix(kOther));
  EXPECT_EQ(sent(question(kOther, 1, count++), writer, milliseconds(at)), writer) << "it may come again";
}

TEST_F(IntroducedTraffic, TellsOfEndpointsThatEndUntilAllOfThemDo) {
  const std::vector<Locator> all = {shared_memory(1), shared_memory(2)};
  EXPECT_EQ(sent(end_of_endpoint(), all), all);
  traffic_.end_endpoints_silently();
  EXPECT_THAT(sent(end_of_endpoint(), all), IsEmpty());
}

}  // namespace
