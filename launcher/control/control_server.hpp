// SPDX-License-Identifier: Apache-2.0
// Clients of a control socket: lines in, lines out, on the loop of the launcher.
//
// A client can't make the launcher wait, nor fill its memory. What a client does not read stays in a bounded queue, and
// none of its requests is read meanwhile. A client is dropped when its line is too long, when it belongs to another
// user, or when it has read nothing for a while although there is something to read and it has not announced pauses.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

class ControlServer {
 public:
  static constexpr std::size_t kLongestRequest = std::size_t{64} * 1024;
  static constexpr std::size_t kFullQueue = std::size_t{1024} * 1024;
  static constexpr std::size_t kMostClients = 32;
  static constexpr Duration kPatience = std::chrono::seconds(30);

  using ClientId = std::uint64_t;

  struct Callbacks {
    // A client has sent a line, without its end.
    std::function<void(ClientId client, std::string_view line)> request;
    // The queue of a client has room again after offer() has refused something.
    std::function<void(ClientId client)> ready;
    std::function<void(ClientId client)> gone;
    // The line for a client that is dropped, and why.
    std::function<std::string(std::string_view why)> farewell;
  };

  // `listener` is a socket that listens. It and the loop must outlive the server. Throws std::system_error.
  ControlServer(EventLoop& loop, int listener, Callbacks callbacks);
  // Waits for clients that read what is queued for them, but not long.
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  // Queues a line, whose end it adds, however full the queue is: for answers, of which each request has one.
  void send(ClientId client, std::string_view line);
  // Queues a line unless the queue is full. Returns whether it did.
  bool offer(ClientId client, std::string_view line);
  // The client may read nothing for as long as it likes: it only loses what offer() refuses.
  void allow_pauses(ClientId client);

 private:
  struct Client;

  void on_ready();
  void accept_clients();
  void on_client(Client& client, std::uint32_t events);
  void read(Client& client);
  void take_lines(Client& client);
  void write(Client& client);
  void watch(Client& client);
  void finish(Client& client);
  void refuse(Client& client, std::string_view why);
  void drop(Client& client);

  EventLoop& loop_;
  int listener_;
  Callbacks callbacks_;
  UniqueFd epoll_;  // of the listener and the clients
  EventLoop::SourcePtr source_;
  std::map<ClientId, std::unique_ptr<Client>> clients_;
  ClientId last_id_ = 0;
};

}  // namespace launch
