// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/open_connections.hpp"

#include <sys/socket.h>

namespace launch::serve {

void OpenConnections::add(const void* key, int socket, Time now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  connections_[key] = {socket, Doing::kRequest, now};
}

void OpenConnections::set(const void* key, Doing doing, Time now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (const auto found = connections_.find(key); found != connections_.end()) {
    found->second.doing = doing;
    found->second.since = now;
  }
}

void OpenConnections::remove(const void* key) {
  const std::lock_guard<std::mutex> lock(mutex_);
  connections_.erase(key);
}

std::size_t OpenConnections::cut_late(Time now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::size_t cut = 0;
  for (const auto& [key, connection] : connections_) {
    const bool late = (connection.doing == Doing::kRequest && now - connection.since >= kForRequest) ||
                      (connection.doing == Doing::kAnswer && now - connection.since >= kForAnswer);
    if (late) {
      ::shutdown(connection.socket, SHUT_RDWR);
      ++cut;
    }
  }
  return cut;
}

}  // namespace launch::serve
