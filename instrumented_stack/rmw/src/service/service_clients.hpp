// SPDX-License-Identifier: Apache-2.0
// The clients that a service has heard of: whether a response to one would arrive.
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>

#include "types/gid.hpp"

namespace rmw_fastrtps {

// A client has two endpoints, of which discovery tells in any order: a request can come before its reader of responses
// is matched, and a response to a reader that is not matched would be lost. Thread safe.
class ServiceClients {
 public:
  enum class Presence { kMatched, kUnmatched, kGone };

  // A request came from `writer`, to be answered to `reader`.
  void request_taken(const Gid& reader, const Gid& writer);
  // What discovery tells.
  void reader_matched(const Gid& reader);
  void reader_unmatched(const Gid& reader);
  void writer_unmatched(const Gid& writer);

  // Waits up to `patience` for the reader of a client that has sent a request.
  Presence wait_for_reader(const Gid& reader, std::chrono::nanoseconds patience);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<Gid> matched_readers_;
  std::map<Gid, Gid> writers_;  // by the reader of the same client
};

}  // namespace rmw_fastrtps
