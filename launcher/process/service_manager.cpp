// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/service_manager.hpp"

#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace launch {
namespace {

// Removes the variable and returns its value.
std::string take(Environment& environment, const char* name) {
  std::string value;
  if (const auto found = environment.find(name); found != environment.end()) {
    value = found->second;
    environment.erase(name);
  }
  ::unsetenv(name);
  return value;
}

}  // namespace

std::optional<ServiceAddress> ServiceAddress::take(Environment& environment) {
  ServiceAddress address{.socket = launch::take(environment, "NOTIFY_SOCKET")};
  const std::string watchdog = launch::take(environment, "WATCHDOG_USEC");
  // It names the process that systemd has started: the guardian, as soon as there is one.
  const std::string of = launch::take(environment, "WATCHDOG_PID");
  if (address.socket.size() < 2 || (address.socket[0] != '/' && address.socket[0] != '@')) {
    return std::nullopt;
  }
  std::uint64_t microseconds = 0;
  std::from_chars(watchdog.data(), watchdog.data() + watchdog.size(), microseconds);
  if (of.empty() || of == std::to_string(::getpid())) {
    address.watchdog = std::chrono::microseconds(microseconds);
  }
  return address;
}

ServiceManager::ServiceManager(const ServiceAddress& address, EventLoop& loop)
    : socket_(address.socket),
      loop_(loop),
      watchdog_(address.watchdog),
      fd_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  if (watchdog_.count() > 0) {
    feed_watchdog();
  }
}

void ServiceManager::ready() {
  send("READY=1");
}

void ServiceManager::stopping() {
  send("STOPPING=1");
}

void ServiceManager::status(std::string_view text) {
  send("STATUS=" + std::string(text));
}

// News that can't be sent are lost: the launch goes on without a service manager.
void ServiceManager::send(std::string_view news) const {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (socket_.size() >= sizeof address.sun_path) {
    return;
  }
  std::memcpy(address.sun_path, socket_.data(), socket_.size());
  if (socket_[0] == '@') {
    address.sun_path[0] = '\0';
  }
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
  static_cast<void>(
      ::sendto(fd_.get(), news.data(), news.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address), size));
}

void ServiceManager::feed_watchdog() {
  send("WATCHDOG=1");
  timer_ = loop_.after(watchdog_ / 2, [this] { feed_watchdog(); });
}

}  // namespace launch
