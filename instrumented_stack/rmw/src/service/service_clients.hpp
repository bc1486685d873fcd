// SPDX-License-Identifier: Apache-2.0
// The clients that a service knows: whether a response to one would arrive.
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>

#include "types/gid.hpp"

namespace rmw_fastrtps {

// A client has two endpoints, which discovery reports in any order. A request can come before the client's response
// reader is matched, and a response to an unmatched reader would be lost. Thread safe.
class ServiceClients {
 public:
  enum class Presence { kMatched, kUnmatched, kGone };

  // A request came from `writer`; its response goes to `reader`.
  void request_taken(const Gid& reader, const Gid& writer);
  // Reports from discovery.
  void reader_matched(const Gid& reader);
  void reader_unmatched(const Gid& reader);
  void writer_unmatched(const Gid& writer);

  // Waits up to `patience` for the reader of a client that has sent a request.
  Presence wait_for_reader(const Gid& reader, std::chrono::nanoseconds patience);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<Gid> matched_readers_;
  std::map<Gid, Gid> writers_;  // key: the reader of the same client
};

}  // namespace rmw_fastrtps
