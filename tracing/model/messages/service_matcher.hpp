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
  std::uint64_t in_flight = 0;    // without a response when the trace or the client ended, but it was not late yet
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
  // The callback of a service begins and ends in the thread that took the request.
  void begin_work(const Origin& origin);
  void end_work(const Origin& origin);
  // The client takes no response from now on; kNoObject is ignored.
  void end_client(ObjectId client, std::int64_t time_ns);
  void end_process(ProcessId process, std::int64_t time_ns);
  // To be called at the end of the trace: calls without a response will get none. One is in flight, and not
  // unanswered, if the service is working at it when the trace or the client ends, or if it is not older by then than
  // the slowest call of the client that was answered, and 10 ms.
  void finish(std::int64_t end_ns);

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
    bool worked = false;                    // the callback of the service has begun
    std::optional<std::int64_t> worked_ns;  // and ended
  };

  ros2::Gid gid_of(ObjectId client) const;
  Call& begin(const Key& key);
  void end_now(const Key& key);  // a key of calls_
  CallRecord& end(const Call& call);
  bool is_in_flight(const Call& call, std::int64_t end_ns, std::int64_t usual_ns) const;
  std::int64_t end_of(ObjectId client, std::int64_t end_ns) const;

  const ObjectModel& model_;
  ExecutionSink& sink_;
  std::unordered_map<Key, Call, HashKey> calls_;  // calls that have no response yet, or no client in the trace
  std::deque<Key> oldest_first_;                  // the keys of calls_, and of some calls that have ended
  std::map<Pair, CallRecord> records_;
  std::unordered_map<ThreadId, Key, HashThreadId> served_;  // the request that the thread took last
  std::unordered_map<ObjectId, std::int64_t> ended_clients_;
  std::unordered_map<ProcessId, std::int64_t> ended_processes_;
  std::uint64_t unknown_clients_ = 0;
};

}  // namespace tracing
