// SPDX-License-Identifier: Apache-2.0
// Chooses the events of nodes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "tracing/decode/reader/ext_events.hpp"
#include "tracing/decode/reader/ros2_decoder.hpp"
#include "tracing/model/objects/object_model.hpp"
#include "tracing/model/objects/process_table.hpp"

namespace tracing {

// An event belongs to a node if one of its fields is the node or an object of the node: a publisher, a subscription, a
// timer, a service, a client, a callback. And it belongs to a node if a callback of the node runs in its thread, which
// includes the application's own events.
class NodeFilter {
 public:
  // Patterns with `*` and `?` of full names (/ns/talker), or of names without their namespaces.
  explicit NodeFilter(std::vector<std::string> patterns) : patterns_(std::move(patterns)) {}

  // Must be called for each event of the trace, in order.
  bool accepts(const Event& event);

  // The full names of all nodes so far, for a message when none was meant.
  std::vector<std::string> names() const;
  bool has_match() const;

 private:
  struct Thread {
    ProcessId process;
    std::int64_t vtid;
    bool operator==(const Thread&) const = default;
  };
  struct HashThread {
    std::size_t operator()(const Thread& thread) const {
      return std::hash<std::int64_t>()(thread.vtid) * 31 + thread.process;
    }
  };

  // Whether an object in the event belongs to a node that is wanted.
  bool has_wanted_object(const Origin& origin, const ros2::AnyEvent& event);
  bool is_wanted_callback(ObjectId callback) const;
  bool is_wanted(ObjectId node) const;
  bool is_wanted_handle(ProcessId process, std::string_view field, ros2::Handle handle);
  bool is_wanted_end(ProcessId process, const ros2::ObjectEnd& end);

  std::vector<std::string> patterns_;
  mutable std::vector<signed char> is_wanted_;  // by node: 1 wanted, 0 not, -1 not known yet
  ProcessTable processes_;
  ObjectModel model_;
  ros2::Decoder decoder_{[](const std::string&) {}};
  ros2::ObjectEndDecoder ends_;
  std::unordered_map<Thread, std::vector<bool>, HashThread> running_;  // the callbacks that run: whether wanted
  std::unordered_map<Thread, bool, HashThread> state_machines_;        // by process and address
};

}  // namespace tracing
