// SPDX-License-Identifier: Apache-2.0
// The messages between the launcher and launch-watch --conditions: one JSON object a line, both ways. Times are
// seconds.
//
//   {"watch": 1, "kind": "silence", "topic": "/scan", "window": 2.0, "grace": 10.0}            to launch-watch
//   {"watch": 2, "kind": "late", "topic": "/scan", "window": 5.0, "grace": 10.0, "max": 0.02, "share": 0.99}
//   {"forget": 1}
//   {"recording": true}                                                    from launch-watch: the nodes are recorded
//   {"condition": 1, "holds": true, "figure": 2.03, "processes": ["talker-1"]}
//   {"condition": 2, "holds": true, "figure": 0.031, "processes": ["mapper-2"], "late": 0.04}
//   {"unseen": 1, "known": ["/scan2"]}             nothing has the name; what there is of its kind
//   {"behind": 6.1}                                the recording is so far behind that nothing can be decided; 0: again
//   {"error": "there is no 'lttng-relayd' on this machine", "help": "install the package lttng-tools"}    the last one
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tracing/model/conditions/live_condition.hpp"

namespace tracing {

using ConditionId = std::uint64_t;

// To launch-watch.
struct WatchCondition {
  ConditionId id = 0;
  LiveCondition condition;
};
struct ForgetCondition {
  ConditionId id = 0;
};
using ConditionOrder = std::variant<WatchCondition, ForgetCondition>;

// From launch-watch.
struct NodesAreRecorded {};
struct ConditionChanged {
  ConditionId id = 0;
  ConditionChange change;
};
struct NameNotSeen {
  ConditionId id = 0;
  std::vector<std::string> known;
};
struct RecordingIsBehind {
  double seconds = 0;
};
struct WatchFailed {
  std::string error;
  std::string help;
  bool tries_again = false;  // no part of the message
};
using ConditionReport = std::variant<NodesAreRecorded, ConditionChanged, NameNotSeen, RecordingIsBehind, WatchFailed>;

// A message as a line, with its line end.
std::string to_line(const ConditionOrder& order);
std::string to_line(const ConditionReport& report);

// Throw std::runtime_error for any other text.
ConditionOrder parse_condition_order(std::string_view text);
ConditionReport parse_condition_report(std::string_view text);

}  // namespace tracing
