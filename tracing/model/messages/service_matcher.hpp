// SPDX-License-Identifier: Apache-2.0
// Follows requests from a client to a service and their responses back, by the client's gid and the sequence number.
//
// A client records rmw_send_request after it has sent the request, because only then the request has a number. The
// service may have taken it before, and even the response may have come. A part of a call that would be negative for
// this reason counts as 0.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "tracing/model/execution/duration_statistics.hpp"
#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/objects/object_model.hpp"

namespace tracing {

// All calls of one client at one service.
struct CallRecord {
  std::uint64_t requests = 0;     // sent within the trace, or taken when the client is not in the trace
  std::uint64_t responses = 0;    // taken by the client, or sent when the client is not in the trace
  DurationStatistics round_trip;  // rmw_send_request to rmw_take_response
  DurationStatistics request;     // rmw_send_request to rmw_take_request
  DurationStatistics service;     // rmw_take_request to rmw_send_response
  DurationStatistics response;    // rmw_send_response to rmw_take_response
};

class ServiceMatcher {
 public:
  // Tells the sink each call whose response was taken. Both must outlive this object.
  ServiceMatcher(const ObjectModel& model, ExecutionSink& sink) : model_(model), sink_(sink) {}

  // A call without a response is remembered until this many newer calls have begun. That bounds the memory.
  static constexpr std::size_t kRemembered = 16'384;

  void on(const Origin& origin, const ros2::RmwSendRequest& event);
  // When several services take a request, the first one is the one that is called.
  void on(const Origin& origin, const ros2::RmwTakeRequest& event);
  void on(const Origin& origin, const ros2::RmwSendResponse& event);
  void on(const Origin& origin, const ros2::RmwTakeResponse& event);
  // To be called at the end of the trace: calls without a response will get none.
  void finish();

  // Client and service; kNoObject for one that is not in the trace.
  using Pair = std::pair<ObjectId, ObjectId>;
  const std::map<Pair, CallRecord>& records() const { return records_; }
  // Requests of clients whose creation is not in the trace.
  std::uint64_t unknown_clients() const { return unknown_clients_; }

 private:
  struct Key {
    ros2::Gid gid;
    std::int64_t sequence_number = 0;
    bool operator==(const Key&) const = default;
  };
  struct HashKey {
    std::size_t operator()(const Key& key) const;
  };
  struct Call {
    ObjectId client = kNoObject;
    ObjectId service = kNoObject;
    std::optional<std::int64_t> sent_ns;
    std::optional<std::int64_t> taken_ns;
    std::optional<std::int64_t> answered_ns;
    std::optional<std::int64_t> received_ns;
  };

  ros2::Gid gid_of(ObjectId client) const;
  Call& begin(const Key& key);
  void end_now(const Key& key);  // a key of calls_
  void end(const Call& call);

  const ObjectModel& model_;
  ExecutionSink& sink_;
  std::unordered_map<Key, Call, HashKey> calls_;  // calls that have no response yet, or no client in the trace
  std::deque<Key> oldest_first_;                  // the keys of calls_, and of some calls that have ended
  std::map<Pair, CallRecord> records_;
  std::uint64_t unknown_clients_ = 0;
};

}  // namespace tracing
