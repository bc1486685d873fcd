// SPDX-License-Identifier: Apache-2.0
// The participants of a ROS domain that this host has, whether they have been found yet or not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace launch {

// How many sockets of the table are bound to the port. The table is of the form of /proc/net/udp: a line of titles,
// then a line for each socket. What is no such line is passed over.
std::size_t sockets_at(std::string_view table, unsigned port);

// Participants that listen to announcements at the port that DDS has for the domain, of all processes that share this
// network. Those that use shared memory alone do not count.
std::size_t participants_of_host(std::size_t domain, const std::filesystem::path& proc_net = "/proc/net");

// Of DDS. The first 12 bytes are those of the participant.
using EndpointGid = std::array<std::uint8_t, 16>;

struct EndpointOfNode {
  EndpointGid gid{};
  std::string node;  // its full name
};

// Whether all participants can have told their nodes. `participants`: the endpoint of each on which it tells them.
// `endpoints`: some that belong to nodes, but not of each node. `nodes`: how many are known. A participant without an
// endpoint among these has told its nodes if there is one of the other nodes for it.
bool have_told_nodes(const std::vector<EndpointGid>& participants, const std::vector<EndpointOfNode>& endpoints,
                     std::size_t nodes);

}  // namespace launch
