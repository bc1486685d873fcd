// SPDX-License-Identifier: Apache-2.0
// Cuts connections whose client takes too long, however busy it looks: one that sends a byte now and then would hold a
// place for ever. All functions may be called by several threads.
#pragma once

#include <chrono>
#include <map>
#include <mutex>

namespace launch::serve {

class OpenConnections {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr std::chrono::seconds kForRequest{15};  // from the connection, or the last answer, to its last byte
  static constexpr std::chrono::seconds kForAnswer{60};   // to the last byte of the answer

  enum class Doing { kRequest, kAnswer, kFeed };

  // `key` stands for the connection until remove().
  void add(const void* key, int socket, Time now);
  // It begins something else. A feed may take as long as it likes.
  void set(const void* key, Doing doing, Time now);
  // The socket must not be closed before.
  void remove(const void* key);

  // Cuts those that are too late. Returns how many.
  std::size_t cut_late(Time now);

 private:
  struct Connection {
    int socket;
    Doing doing;
    Time since;
  };

  std::mutex mutex_;
  std::map<const void*, Connection> connections_;
};

}  // namespace launch::serve
