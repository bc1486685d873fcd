// SPDX-License-Identifier: Apache-2.0
#include "base/environment/domain_lease.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>

namespace launch {
namespace {

// Participants of these domains use ports below those that Linux gives to anyone. 0 is what people work with.
constexpr int kFirstDomain = 1;
constexpr int kLastDomain = 101;
constexpr int kFirstPort = 32768;

// The ports of a participant, DDSI-RTPS 9.6.1.1.
constexpr int kDdsPorts = 7400;
constexpr int kPortsOfDomain = 250;

// Domains whose UDP ports are in use.
std::set<int> used_domains() {
  std::set<int> used;
  for (const char* const path : {"/proc/net/udp", "/proc/net/udp6"}) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);  // the heading
    while (std::getline(file, line)) {
      // "  42: 00000000:1CE8 00000000:0000 …": the local address and port, hexadecimal.
      const std::size_t address = line.find(": ");
      const std::size_t port = address == std::string::npos ? address : line.find(':', address + 1);
      if (port == std::string::npos) {
        continue;
      }
      const int number = std::stoi(line.substr(port + 1, 4), nullptr, 16);
      if (number >= kDdsPorts) {
        used.insert((number - kDdsPorts) / kPortsOfDomain);
      }
    }
  }
  return used;
}

}  // namespace

DomainLease::DomainLease() {
  constexpr int kCount = kLastDomain - kFirstDomain + 1;
  const std::set<int> used = used_domains();
  for (int i = 0; i < kCount; ++i) {
    // Leases that are taken at the same time begin at different places.
    const int id = kFirstDomain + (static_cast<int>(::getpid()) + i) % kCount;
    if (used.count(id) != 0) {
      continue;
    }
    UniqueFd socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (!socket) {
      throw std::system_error(errno, std::system_category(), "cannot lease a ROS domain");
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<in_port_t>(kFirstPort + id));
    address.sin_addr.s_addr = htonl(INADDR_ANY);
    if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
      id_ = id;
      socket_ = std::move(socket);
      return;
    }
  }
  throw std::runtime_error(
      fmt::format("no ROS domain is free: {} to {} are leased or in use", kFirstDomain, kLastDomain));
}

}  // namespace launch
