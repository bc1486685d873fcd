// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/calculations/participants.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/sandbox.hpp"

using launch::EndpointGid;
using launch::EndpointOfNode;
using launch::have_told_nodes;
using launch::participants_of_host;
using launch::sockets_at;

namespace {

constexpr const char* kTitles =
    "   sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode ref pointer "
    "drops\n";

TEST(Participants, AreTheSocketsAtThePort) {
  const std::string table = std::string(kTitles) +
                            "  732: 00000000:8A73 00000000:0000 07 00000000:00000000 00:00000000 00000000 0 0 1 2 a 0\n"
                            " 6207: 00000000:1FD6 00000000:0000 07 00000000:00000000 00:00000000 00000000 0 0 2 2 b 0\n"
                            " 6207: 0100007F:1FD6 00000000:0000 07 00000000:00000000 00:00000000 00000000 0 0 3 2 c 0\n"
                            " 6217: 00000000:1FE0 00000000:0000 07 00000000:00000000 00:00000000 00000000 0 0 4 2 d 0";
  EXPECT_EQ(sockets_at(table, 8150), 2);
  EXPECT_EQ(sockets_at(table, 8160), 1);
  EXPECT_EQ(sockets_at(table, 7400), 0);
}

TEST(Participants, AreNotInWhatIsNoTable) {
  for (const char* const text : {"", "\n\n", ":", "a: b", " 1: 00:", " 1: 00:xyz", "::::", kTitles}) {
    EXPECT_EQ(sockets_at(text, 0), 0) << text;
  }
}

// The endpoint `number` of a participant.
EndpointGid gid(std::uint8_t participant, std::uint8_t number) {
  EndpointGid gid{};
  gid[11] = participant;
  gid[15] = number;
  return gid;
}

TEST(Participants, HaveToldTheirNodesWhenOneIsKnownOfEach) {
  const std::vector<EndpointGid> participants = {gid(1, 1), gid(2, 1)};
  EXPECT_FALSE(have_told_nodes(participants, {}, 0));
  EXPECT_FALSE(have_told_nodes(participants, {{gid(1, 2), "/a"}}, 1));
  EXPECT_TRUE(have_told_nodes(participants, {{gid(1, 2), "/a"}, {gid(2, 2), "/b"}}, 2));
  EXPECT_TRUE(have_told_nodes({}, {}, 0));
}

TEST(Participants, MayHaveNodesWithoutAnyOfTheEndpoints) {
  const std::vector<EndpointGid> participants = {gid(1, 1), gid(2, 1), gid(3, 1)};
  const std::vector<EndpointOfNode> container = {{gid(1, 2), "/a"}, {gid(1, 3), "/a"}, {gid(1, 4), "/b"}};
  EXPECT_FALSE(have_told_nodes(participants, container, 3)) << "one is known beside those of the container";
  EXPECT_TRUE(have_told_nodes(participants, container, 4));
}

TEST(Participants, AreCountedByDomain) {
  const test_support::Sandbox sandbox;
  std::ofstream(sandbox.directory() / "udp") << kTitles << "  1: 00000000:1CE8 00000000:0000 07\n"
                                             << "  2: 00000000:1DE2 00000000:0000 07\n";
  std::ofstream(sandbox.directory() / "udp6")
      << kTitles << "  3: 00000000000000000000000000000000:1CE8 00000000000000000000000000000000:0000 07\n";
  EXPECT_EQ(participants_of_host(0, sandbox.directory()), 2);
  EXPECT_EQ(participants_of_host(1, sandbox.directory()), 1);
  EXPECT_EQ(participants_of_host(2, sandbox.directory()), 0);
  EXPECT_EQ(participants_of_host(0, sandbox.directory() / "nowhere"), 0);
}

}  // namespace
