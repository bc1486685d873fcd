// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/calculations/participants.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace launch {

namespace {

// Of DDS's rules for ports: that of announcements is kBase + kOfDomain * domain.
constexpr unsigned kBase = 7400;
constexpr unsigned kOfDomain = 250;

}  // namespace

std::size_t sockets_at(std::string_view table, unsigned port) {
  std::size_t count = 0;
  while (!table.empty()) {
    const std::string_view line = table.substr(0, table.find('\n'));
    table.remove_prefix(std::min(line.size() + 1, table.size()));
    // "  732: 00000000:1FD6 00000000:0000 …"
    const std::size_t begin = line.find(':', line.find(": ") + 1);
    unsigned bound = 0;
    if (line.find(": ") != std::string_view::npos && begin != std::string_view::npos &&
        std::from_chars(line.data() + begin + 1, line.data() + line.size(), bound, 16).ec == std::errc() &&
        bound == port) {
      ++count;
    }
  }
  return count;
}

std::size_t participants_of_host(std::size_t domain, const std::filesystem::path& proc_net) {
  std::size_t count = 0;
  for (const char* const name : {"udp", "udp6"}) {
    std::ifstream file(proc_net / name);
    const std::string table(std::istreambuf_iterator<char>(file), {});
    count += sockets_at(table, kBase + kOfDomain * static_cast<unsigned>(domain));
  }
  return count;
}

bool have_told_nodes(const std::vector<EndpointGid>& participants, const std::vector<EndpointOfNode>& endpoints,
                     std::size_t nodes) {
  using Prefix = std::array<std::uint8_t, 12>;
  const auto prefix_of = [](const EndpointGid& gid) {
    Prefix prefix{};
    std::copy_n(gid.begin(), prefix.size(), prefix.begin());
    return prefix;
  };
  std::set<Prefix> told;
  std::set<std::string> named;
  for (const EndpointOfNode& endpoint : endpoints) {
    told.insert(prefix_of(endpoint.gid));
    named.insert(endpoint.node);
  }
  const auto silent = static_cast<std::size_t>(
      std::count_if(participants.begin(), participants.end(),
                    [&](const EndpointGid& participant) { return told.count(prefix_of(participant)) == 0; }));
  return nodes >= named.size() + silent;
}

}  // namespace launch
