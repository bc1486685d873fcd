// SPDX-License-Identifier: Apache-2.0
#include "launcher/traced/snapshot_socket.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <functional>

namespace launch {
namespace {

// The first byte of an answer.
constexpr char kComplete = 'c';
constexpr char kIncomplete = 'i';
constexpr char kError = 'e';

constexpr int kMostWaiting = 16;
constexpr std::size_t kLongestAnswer = 16UL * 1024;

UniqueFd make_socket(int flags) {
  return UniqueFd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | flags, 0));
}

// Calls `act`, which is bind() or connect(), with the address.
template <typename Act>
bool with_address(const std::string& session, const Act& act) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // The name of a session may be longer than that of a socket.
  const std::string name = fmt::format("launch-snapshot-{}-{:016x}", ::geteuid(), std::hash<std::string>{}(session));
  std::copy(name.begin(), name.end(), address.sun_path + 1);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return act(reinterpret_cast<const sockaddr*>(&address), size) == 0;
}

// Any user may take any name.
bool is_own_or_root(const UniqueFd& socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return ::getsockopt(socket.get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 &&
         (peer.uid == ::geteuid() || peer.uid == 0);
}

}  // namespace

UniqueFd listen_for_snapshots(const std::string& session) {
  UniqueFd socket = make_socket(SOCK_NONBLOCK);
  const bool listens = socket &&
                       with_address(session, [&](const sockaddr* address,
                                                 socklen_t size) { return ::bind(socket.get(), address, size); }) &&
                       ::listen(socket.get(), kMostWaiting) == 0;
  return listens ? std::move(socket) : UniqueFd();
}

UniqueFd take_snapshot_request(const UniqueFd& listener) {
  UniqueFd asker(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  return asker && is_own_or_root(asker) ? std::move(asker) : UniqueFd();
}

void send_snapshot_answer(const UniqueFd& asker, const SnapshotAnswer& answer) {
  const std::string text =
      answer.error.empty() ? (answer.complete ? kComplete : kIncomplete) + answer.directory : kError + answer.error;
  // It fits into the buffer of a socket on which nothing was sent before; if nobody listens any more, nobody misses it.
  static_cast<void>(::send(asker.get(), text.data(), std::min(text.size(), kLongestAnswer), MSG_NOSIGNAL));
}

std::optional<SnapshotAnswer> ask_for_snapshot(const std::string& session) {
  const UniqueFd socket = make_socket(0);
  const bool connected = socket && with_address(session, [&](const sockaddr* address, socklen_t size) {
                           return ::connect(socket.get(), address, size);
                         });
  if (!connected || !is_own_or_root(socket)) {
    return std::nullopt;
  }
  std::string text;
  std::array<char, 4096> bytes;  // not initialised: it is read into
  while (text.size() <= kLongestAnswer) {
    const ssize_t count = ::recv(socket.get(), bytes.data(), bytes.size(), 0);
    if (count > 0) {
      text.append(bytes.data(), static_cast<std::size_t>(count));
    } else if (count == 0 || errno != EINTR) {
      break;
    }
  }
  if (text.empty()) {
    return SnapshotAnswer{.error = "the launch has ended before the snapshot was there"};
  }
  const char kind = text.front();
  text.erase(0, 1);
  return kind == kError ? SnapshotAnswer{.error = std::move(text)}
                        : SnapshotAnswer{.directory = std::move(text), .complete = kind == kComplete};
}

}  // namespace launch
