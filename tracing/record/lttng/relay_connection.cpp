// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/relay_connection.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>

#include "base/processes/process_stat.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRelayDaemon = "lttng-relayd";
constexpr std::string_view kDataPort = "[data: ";
// Documentation/networking/proc_net_tcp.rst of the kernel
constexpr int kEstablished = 1;
constexpr std::string_view kZeroWindow = "04:";

std::uint16_t port_at(std::string_view text, std::uint16_t otherwise) {
  std::uint16_t port = 0;
  std::from_chars(text.data(), text.data() + text.size(), port);
  return port != 0 ? port : otherwise;
}

// The inodes of the sockets that a process has open; nothing if this user may not see them.
std::optional<std::set<std::uint64_t>> sockets_of(pid_t process) {
  constexpr std::string_view kSocket = "socket:[";
  std::set<std::uint64_t> inodes;
  std::error_code error;
  fs::directory_iterator entry(fmt::format("/proc/{}/fd", process), error);
  if (error == std::errc::permission_denied) {
    return std::nullopt;
  }
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code gone;
    const std::string target = fs::read_symlink(entry->path(), gone).string();
    if (gone || !target.starts_with(kSocket)) {
      continue;
    }
    inodes.insert(std::strtoull(target.c_str() + kSocket.size(), nullptr, 10));
  }
  return inodes;
}

struct Connection {
  std::string peer;        // the address as /proc/net/tcp has it: hexadecimal
  bool is_silent = false;  // the peer has no room for more, or does not confirm what was sent
};

// The established connections of the process to one of the ports; nothing if this user may not see them.
std::optional<std::vector<Connection>> connections_of(pid_t process, const RelayPorts& ports) {
  const std::optional<std::set<std::uint64_t>> sockets = sockets_of(process);
  if (!sockets) {
    return std::nullopt;
  }
  std::vector<Connection> found;
  for (const char* protocol : {"tcp", "tcp6"}) {
    std::ifstream file(fmt::format("/proc/{}/net/{}", process, protocol));
    std::string line;
    std::getline(file, line);  // the heading
    while (std::getline(file, line)) {
      std::istringstream fields(line);
      std::string number, local, remote, state, queues, timer, retransmits, user, timeout;
      std::uint64_t inode = 0;
      fields >> number >> local >> remote >> state >> queues >> timer >> retransmits >> user >> timeout >> inode;
      const std::size_t colon = remote.rfind(':');
      if (!fields || colon == std::string::npos || std::stoi(state, nullptr, 16) != kEstablished) {
        continue;
      }
      const auto port = static_cast<std::uint16_t>(std::stoi(remote.substr(colon + 1), nullptr, 16));
      if ((port != ports.control && port != ports.data) || !sockets->contains(inode)) {
        continue;
      }
      found.push_back({.peer = remote.substr(0, colon),
                       .is_silent = timer.starts_with(kZeroWindow) || std::stoi(retransmits, nullptr, 16) != 0});
    }
  }
  return found;
}

// 127.x.x.x, ::1, or the former within the latter's space.
bool is_this_machine(const std::string& peer) {
  return peer.size() == 8 ? peer.ends_with("7F")
                          : peer == "00000000000000000000000001000000" || peer.ends_with("FFFF00000100007F");
}

}  // namespace

std::vector<pid_t> stopped_relay_daemons(pid_t process) {
  std::error_code error;
  const fs::path network = fs::read_symlink(fmt::format("/proc/{}/ns/net", process), error);
  if (error) {
    return {};
  }
  std::vector<pid_t> stopped;
  fs::directory_iterator entry("/proc", error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const pid_t pid = static_cast<pid_t>(std::strtol(entry->path().filename().c_str(), nullptr, 10));
    if (pid <= 0) {
      continue;
    }
    const launch::ProcessStat found = launch::read_process_stat(pid);
    if (found.name != kRelayDaemon || found.state == 'Z') {
      continue;
    }
    std::error_code hidden;
    if (fs::read_symlink(entry->path() / "ns/net", hidden) != network || hidden) {
      continue;
    }
    if (found.state != 'T' && found.state != 't') {
      return {};
    }
    stopped.push_back(pid);
  }
  return stopped;
}

RelayPorts relay_ports(const std::string& address) {
  RelayPorts ports;
  const std::size_t scheme = address.find("://");
  std::string_view rest(address);
  rest.remove_prefix(scheme == std::string::npos ? 0 : scheme + 3);
  if (rest.starts_with('[')) {
    rest.remove_prefix(std::min(rest.find(']'), rest.size()));  // an IPv6 address
  }
  const std::string_view authority = rest.substr(0, rest.find('/'));
  if (const std::size_t colon = authority.find(':'); colon != std::string_view::npos) {
    ports.control = port_at(authority.substr(colon + 1), ports.control);
    const std::size_t second = authority.find(':', colon + 1);
    if (second != std::string_view::npos) {
      ports.data = port_at(authority.substr(second + 1), ports.data);
    }
  }
  if (const std::size_t data = rest.find(kDataPort); data != std::string_view::npos) {
    ports.data = port_at(rest.substr(data + kDataPort.size()), ports.data);
  }
  return ports;
}

RelayConnection::State RelayConnection::look() {
  bool works = false;
  bool is_silent = false;
  for (const pid_t consumer : consumers_) {
    bool local = false;
    const std::optional<std::vector<Connection>> connections = connections_of(consumer, ports_);
    if (!connections) {
      return State::kUnknown;
    }
    for (const Connection& connection : *connections) {
      works = true;
      is_silent = is_silent || connection.is_silent;
      local = local || is_this_machine(connection.peer);
    }
    if (local && !stopped_relay_daemons(consumer).empty()) {
      return State::kSilent;
    }
  }
  if (!works) {
    return State::kEnded;
  }
  silence_ = is_silent ? silence_ + 1 : 0;
  return silence_ >= kLongestSilence ? State::kSilent : State::kWorks;
}

std::vector<pid_t> RelayConnection::stopped_daemons() const {
  std::vector<pid_t> stopped;
  for (const pid_t consumer : consumers_) {
    const std::optional<std::vector<Connection>> connections = connections_of(consumer, ports_);
    if (connections && std::any_of(connections->begin(), connections->end(),
                                   [](const Connection& connection) { return is_this_machine(connection.peer); })) {
      const std::vector<pid_t> found = stopped_relay_daemons(consumer);
      stopped.insert(stopped.end(), found.begin(), found.end());
    }
  }
  return stopped;
}

}  // namespace tracing
