// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/control_server.hpp"

#include <poll.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

namespace launch {
namespace {

constexpr std::uint64_t kListener = 0;  // no client has this number
constexpr int kFinishPatience = 200;    // milliseconds, with a client that reads nothing
constexpr Duration kLongestFinish = std::chrono::seconds(2);

bool is_own_user(int socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 && (peer.uid == ::geteuid() || peer.uid == 0);
}

}  // namespace

struct ControlServer::Client {
  ClientId id;
  UniqueFd fd;
  std::string in;
  std::string out;
  std::size_t written = 0;  // of `out`
  std::uint32_t watched = 0;
  bool may_pause = false;       // it is not dropped when it reads nothing for a while
  bool waits_for_room = false;  // offer() has refused something
  bool finished = false;        // sends nothing more: it is dropped when it has got everything
  bool dead = false;
  EventLoop::SourcePtr patience;

  std::size_t queued() const { return out.size() - written; }
  bool full() const { return queued() >= kFullQueue; }
};

ControlServer::ControlServer(EventLoop& loop, int listener, Callbacks callbacks)
    : loop_(loop), listener_(listener), callbacks_(std::move(callbacks)), epoll_(::epoll_create1(EPOLL_CLOEXEC)) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = kListener;
  if (!epoll_ || ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, listener_, &event) != 0) {
    throw std::system_error(errno, std::system_category(), "cannot watch the control socket");
  }
  source_ = loop_.on_readable(epoll_.get(), [this] { on_ready(); });
}

ControlServer::~ControlServer() {
  for (const auto& [id, client] : clients_) {
    finish(*client);
  }
}

// The end of a launch is told last, so a client that reads gets what its queue holds.
void ControlServer::finish(Client& client) {
  const Duration latest = loop_.now() + kLongestFinish;
  pollfd writable{client.fd.get(), POLLOUT, 0};
  while (client.queued() > 0 && loop_.now() < latest && ::poll(&writable, 1, kFinishPatience) > 0) {
    const ssize_t count =
        ::send(client.fd.get(), client.out.data() + client.written, client.queued(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count <= 0) {
      return;
    }
    client.written += static_cast<std::size_t>(count);
  }
}

void ControlServer::on_ready() {
  std::array<epoll_event, 16> events{};
  const int count = ::epoll_wait(epoll_.get(), events.data(), events.size(), 0);
  for (int i = 0; i < count; ++i) {
    if (events[i].data.u64 == kListener) {
      accept_clients();
    } else if (const auto found = clients_.find(events[i].data.u64); found != clients_.end()) {
      on_client(*found->second, events[i].events);
    }
  }
}

void ControlServer::accept_clients() {
  UniqueFd fd(::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!fd || !is_own_user(fd.get())) {
    return;
  }
  auto client = std::make_unique<Client>();
  client->id = ++last_id_;
  client->fd = std::move(fd);
  epoll_event event{};
  event.data.u64 = client->id;
  if (::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, client->fd.get(), &event) != 0) {
    return;
  }
  Client& added = *clients_.emplace(client->id, std::move(client)).first->second;
  if (clients_.size() > kMostClients) {
    refuse(added, "too many clients");
  } else {
    watch(added);
  }
}

void ControlServer::on_client(Client& client, std::uint32_t events) {
  if ((events & (EPOLLERR | EPOLLHUP)) != 0 && (events & EPOLLIN) == 0) {
    drop(client);
    return;
  }
  if ((events & EPOLLOUT) != 0) {
    write(client);
    take_lines(client);
  }
  if ((events & EPOLLIN) != 0 && !client.dead) {
    read(client);
  }
  if (client.dead || (client.finished && client.queued() == 0)) {
    drop(client);
    return;
  }
  watch(client);
}

void ControlServer::read(Client& client) {
  std::array<char, 16 * 1024> buffer;  // not initialised: it is read into
  const ssize_t count = ::recv(client.fd.get(), buffer.data(), buffer.size(), 0);
  if (count > 0) {
    client.in.append(buffer.data(), static_cast<std::size_t>(count));
    take_lines(client);
  } else if (count == 0) {
    client.finished = true;
  } else if (errno != EAGAIN && errno != EINTR) {
    client.dead = true;
  }
}

void ControlServer::take_lines(Client& client) {
  std::size_t begin = 0;
  for (std::size_t end; !client.full() && (end = client.in.find('\n', begin)) != std::string::npos; begin = end + 1) {
    callbacks_.request(client.id, std::string_view(client.in).substr(begin, end - begin));
  }
  client.in.erase(0, begin);
  if (client.in.size() > kLongestRequest && client.in.find('\n') == std::string::npos) {
    refuse(client, "a request is too long");
  }
}

void ControlServer::send(ClientId id, std::string_view line) {
  const auto found = clients_.find(id);
  if (found == clients_.end() || found->second->dead) {
    return;
  }
  Client& client = *found->second;
  const bool was_empty = client.queued() == 0;
  client.out.append(line).push_back('\n');
  if (was_empty) {
    write(client);
    watch(client);
  }
}

bool ControlServer::offer(ClientId id, std::string_view line) {
  const auto found = clients_.find(id);
  if (found == clients_.end()) {
    return false;
  }
  if (found->second->full()) {
    found->second->waits_for_room = true;
    return false;
  }
  send(id, line);
  return true;
}

void ControlServer::allow_pauses(ClientId id) {
  if (const auto found = clients_.find(id); found != clients_.end()) {
    found->second->may_pause = true;
    found->second->patience.reset();
  }
}

void ControlServer::write(Client& client) {
  while (client.queued() > 0) {
    const ssize_t count =
        ::send(client.fd.get(), client.out.data() + client.written, client.queued(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0) {
      client.dead = client.dead || (errno != EAGAIN && errno != EINTR);
      break;
    }
    client.written += static_cast<std::size_t>(count);
    client.patience.reset();
  }
  if (client.queued() == 0) {
    client.out.clear();
    client.written = 0;
    client.patience.reset();
  } else if (client.written > kFullQueue) {
    client.out.erase(0, client.written);
    client.written = 0;
  }
  if (client.queued() > 0 && !client.patience && !client.may_pause) {
    client.patience = loop_.after(kPatience, [this, id = client.id] {
      if (const auto found = clients_.find(id); found != clients_.end()) {
        drop(*found->second);
      }
    });
  }
  if (client.queued() < kFullQueue / 2 && !client.dead) {
    if (std::exchange(client.waits_for_room, false)) {
      callbacks_.ready(client.id);
    }
  }
}

void ControlServer::watch(Client& client) {
  // A socket that is dead or has got everything is writable, too, so on_client() drops its client.
  std::uint32_t wanted = client.queued() > 0 || client.dead || client.finished ? std::uint32_t{EPOLLOUT} : 0;
  if (!client.finished && !client.dead && !client.full()) {
    wanted |= EPOLLIN;
  }
  if (wanted == client.watched) {
    return;
  }
  epoll_event event{};
  event.events = wanted;
  event.data.u64 = client.id;
  ::epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, client.fd.get(), &event);
  client.watched = wanted;
}

void ControlServer::refuse(Client& client, std::string_view why) {
  client.in.clear();
  client.finished = true;
  send(client.id, callbacks_.farewell(why));
  watch(client);
}

void ControlServer::drop(Client& client) {
  const ClientId id = client.id;
  clients_.erase(id);
  callbacks_.gone(id);
}

}  // namespace launch
