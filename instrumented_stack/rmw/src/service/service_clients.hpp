// SPDX-License-Identifier: Apache-2.0
// The clients that a service knows: whether a response to one would arrive.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <vector>

#include "types/gid.hpp"

namespace rmw_fastrtps {

// A client has two endpoints, which discovery reports in any order. A request can come before the client's response
// reader is matched, and a response to an unmatched reader would be lost. Thread safe.
class ServiceClients {
 public:
  enum class Presence { kMatched, kUnmatched, kGone };
  using Send = std::function<void()>;

  // At most so many responses wait for the reader of one client: as many as a service keeps by default.
  static constexpr std::size_t kMostWaiting = 10;

  // A request came from `writer`; its response goes to `reader`.
  void request_taken(const Gid& reader, const Gid& writer);

  // Reports from discovery. Responses that wait for a reader are sent when it is matched, and forgotten when the client
  // goes.
  void reader_matched(const Gid& reader);
  void reader_unmatched(const Gid& reader);
  void writer_unmatched(const Gid& writer);

  // Of a client that has sent a request.
  Presence presence_of(const Gid& reader) const;

  // Calls `send` when the reader of a client is matched, in the thread that reports it; here if it is matched by now.
  // False if too many wait already.
  bool send_when_matched(const Gid& reader, Send send);

  // Waits at most `patience` until no response waits.
  void wait_until_sent(std::chrono::nanoseconds patience);

 private:
  struct Client {
    Gid writer;
    std::vector<Send> waiting{};
  };

  // The caller holds the mutex.
  void forget(std::size_t responses);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t waiting_ = 0;  // of all clients, and those that are just being sent
  std::set<Gid> matched_readers_;
  std::map<Gid, Client> clients_;  // by their readers
};

}  // namespace rmw_fastrtps
