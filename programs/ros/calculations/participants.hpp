// SPDX-License-Identifier: Apache-2.0
// The participants of a ROS domain that this host has, whether they have been found yet or not.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace launch {

// How many sockets of the table are bound to the port. The table is of the form of /proc/net/udp: a line of titles,
// then a line for each socket. What is no such line is passed over.
std::size_t sockets_at(std::string_view table, unsigned port);

// Participants that listen to announcements at the port that DDS has for the domain, of all processes that share this
// network. Those that use shared memory alone do not count.
std::size_t participants_of_host(std::size_t domain, const std::filesystem::path& proc_net = "/proc/net");

}  // namespace launch
