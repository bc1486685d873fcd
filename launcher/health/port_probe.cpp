// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/port_probe.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <system_error>

namespace launch {
namespace {

struct Address {
  sockaddr_storage storage{};
  socklen_t size = 0;

  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

// Of an IP address that is one (watch.cpp).
Address address_of_port(const std::string& host, std::uint16_t port) {
  Address address;
  auto* const v4 = reinterpret_cast<sockaddr_in*>(&address.storage);
  if (::inet_pton(AF_INET, host.c_str(), &v4->sin_addr) == 1) {
    v4->sin_family = AF_INET;
    v4->sin_port = htons(port);
    address.size = sizeof *v4;
    return address;
  }
  auto* const v6 = reinterpret_cast<sockaddr_in6*>(&address.storage);
  ::inet_pton(AF_INET6, host.c_str(), &v6->sin6_addr);
  v6->sin6_family = AF_INET6;
  v6->sin6_port = htons(port);
  address.size = sizeof *v6;
  return address;
}

Address address_of_socket(const std::string& path) {
  Address address;
  auto* const unix_address = reinterpret_cast<sockaddr_un*>(&address.storage);
  unix_address->sun_family = AF_UNIX;
  const std::size_t length = std::min(path.size(), sizeof unix_address->sun_path);
  std::memcpy(unix_address->sun_path, path.data(), length);
  if (!path.empty() && path[0] == '@') {
    unix_address->sun_path[0] = '\0';
  }
  address.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + length);
  return address;
}

// 0, or an errno; EINPROGRESS leaves the connection under way.
int connect(UniqueFd& connection, int family, int type, const Address& address) {
  connection.reset(::socket(family, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!connection) {
    return errno;
  }
  return ::connect(connection.get(), address.get(), address.size) == 0 ? 0 : errno;
}

}  // namespace

Look PortProbe::look(Duration, Duration) {
  if (connection_) {
    return {};
  }
  switch (port_.protocol) {
    case PortAccepts::Protocol::kUdp:
      return look_for_bound_port();
    case PortAccepts::Protocol::kUnix:
      return connect_to_socket();
    case PortAccepts::Protocol::kTcp:
      break;
  }
  if (!is_elsewhere_) {
    is_elsewhere_ = is_elsewhere();
  }
  if (*is_elsewhere_) {
    return {.note = "it has a network of its own, so its port can't be watched; watch it by a command"};
  }
  if (port_.host != "localhost") {
    return connect_to_port(port_.host);
  }
  has_fallback_ = true;
  return or_fallback(connect_to_port("127.0.0.1"));
}

// "localhost" has two addresses.
Look PortProbe::or_fallback(Look look) {
  return look.result == Look::Result::kBad && std::exchange(has_fallback_, false) ? connect_to_port("::1") : look;
}

Look PortProbe::refused(int error) const {
  return {Look::Result::kBad, fmt::format("{} does not accept connections: {}", address_of(port_), ::strerror(error))};
}

Look PortProbe::connect_to_socket() const {
  const Address address = address_of_socket(port_.socket);
  int error = 0;
  for (const int type : {SOCK_STREAM, SOCK_SEQPACKET, SOCK_DGRAM}) {
    UniqueFd connection;
    error = connect(connection, AF_UNIX, type, address);
    // Of an abstract socket, the kernel looks for the name and the type.
    if (error != EPROTOTYPE && error != ECONNREFUSED) {
      break;
    }
  }
  return error == 0 ? Look{Look::Result::kGood} : refused(error);
}

Look PortProbe::connect_to_port(const std::string& host) {
  const Address address = address_of_port(host, port_.port);
  const int error = connect(connection_, address.storage.ss_family, SOCK_STREAM, address);
  if (error == EINPROGRESS) {
    connected_ = loop_.on_writable(connection_.get(), [this] { on_connected(); });
    too_late_ = loop_.after(timeout_, [this] {
      abandon();
      answer_({Look::Result::kBad, fmt::format("{} has not accepted a connection within {} s", address_of(port_),
                                               std::chrono::duration<double>(timeout_).count())});
    });
    return {};
  }
  abandon();
  return error == 0 ? Look{Look::Result::kGood} : refused(error);
}

void PortProbe::on_connected() {
  int error = 0;
  socklen_t size = sizeof error;
  ::getsockopt(connection_.get(), SOL_SOCKET, SO_ERROR, &error, &size);
  abandon();
  const Look look = or_fallback(error == 0 ? Look{Look::Result::kGood} : refused(error));
  if (look.result != Look::Result::kPending) {
    answer_(look);
  }
}

void PortProbe::abandon() {
  too_late_.reset();
  connected_.reset();  // before its descriptor
  connection_.reset();
}

// Whether the process is in another network namespace than the launcher, as with `launch --isolate`.
bool PortProbe::is_elsewhere() const {
  std::error_code gone;
  const auto network_of = [&](const std::string& process) {
    return std::filesystem::read_symlink(fmt::format("{}/{}/ns/net", proc_, process), gone);
  };
  const auto network = network_of(std::to_string(pid_));
  return !network.empty() && network != network_of("self");
}

// udp(7), /proc/net/udp: "  sl  local_address …", "  12: 0100007F:1F90 …".
Look PortProbe::look_for_bound_port() const {
  const std::string end = fmt::format(":{:04X}", port_.port);
  for (const char* const table : {"udp", "udp6"}) {
    std::ifstream file(fmt::format("{}/{}/net/{}", proc_, pid_, table));
    std::string line;
    std::getline(file, line);
    std::string slot;
    std::string local;
    while (file >> slot >> local && std::getline(file, line)) {
      if (local.ends_with(end)) {
        return {Look::Result::kGood};
      }
    }
  }
  return {Look::Result::kBad, fmt::format("nobody has the UDP port {}", port_.port)};
}

}  // namespace launch
