// SPDX-License-Identifier: Apache-2.0
#include "registration/daemon_connection.hpp"

#include <dirent.h>
#include <stddef.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace tracetools {
namespace {

constexpr std::string_view kSocket = "/lttng-ust-sock-";
constexpr timeval kLttngsTimeout{.tv_sec = 3, .tv_usec = 0};

bool is_connected_to_daemon(int descriptor) {
  sockaddr_un address{};
  socklen_t length = sizeof address;
  if (getpeername(descriptor, reinterpret_cast<sockaddr*>(&address), &length) != 0) {
    return false;
  }
  if (address.sun_family != AF_UNIX || length <= offsetof(sockaddr_un, sun_path)) {
    return false;
  }
  const std::string_view path(address.sun_path,
                              std::min<std::size_t>(length, sizeof address) - offsetof(sockaddr_un, sun_path));
  return path.find(kSocket) != std::string_view::npos;
}

std::optional<DaemonConnection> connection_of(int descriptor) {
  if (!is_connected_to_daemon(descriptor)) {
    return std::nullopt;
  }
  ucred peer{};
  socklen_t length = sizeof peer;
  if (getsockopt(descriptor, SOL_SOCKET, SO_PEERCRED, &peer, &length) != 0) {
    return std::nullopt;
  }
  return DaemonConnection(descriptor, peer.pid);
}

bool has_timeout(int descriptor, int option) {
  timeval timeout{};
  socklen_t length = sizeof timeout;
  return getsockopt(descriptor, SOL_SOCKET, option, &timeout, &length) == 0 && timeout.tv_sec != 0;
}

}  // namespace

std::vector<DaemonConnection> daemon_connections() {
  std::vector<DaemonConnection> connections;
  DIR* const directory = opendir("/proc/self/fd");
  if (directory == nullptr) {
    return connections;
  }
  while (const dirent* const entry = readdir(directory)) {
    if (entry->d_name[0] == '.') {
      continue;
    }
    if (const auto found = connection_of(std::atoi(entry->d_name))) {
      connections.push_back(*found);
    }
  }
  closedir(directory);
  return connections;
}

void DaemonConnection::shut_down() const {
  shutdown(descriptor_, SHUT_RDWR);
}

void DaemonConnection::use_default_timeout() const {
  for (const int option : {SO_RCVTIMEO, SO_SNDTIMEO}) {
    if (has_timeout(descriptor_, option)) {
      setsockopt(descriptor_, SOL_SOCKET, option, &kLttngsTimeout, sizeof kLttngsTimeout);
    }
  }
}

}  // namespace tracetools
