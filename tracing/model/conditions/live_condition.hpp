// SPDX-License-Identifier: Apache-2.0
// A condition on what nodes do while they run: plain data.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace tracing {

struct LiveCondition {
  enum class Kind {
    kSilence,  // nothing has happened for `window`
    kRate,     // so much, or so little, has happened in `window`
    kLate,     // of what has happened in `window`, less than `share` took no longer than `max`
  };
  enum class Subject {
    kTopic,    // something happens when a message is published; late: it takes until the begin of a callback for it
    kNode,     // something happens when a callback of the node ends; late: it takes as long as the callback runs
    kService,  // late only: from the request of a client until it takes the response
  };

  Kind kind = Kind::kSilence;
  Subject subject = Subject::kTopic;
  std::string name = {};  // the full name of the topic, node or service
  std::chrono::nanoseconds window{0};
  std::optional<double> below = std::nullopt;  // of kRate: one of both, in Hz
  std::optional<double> above = std::nullopt;
  std::chrono::nanoseconds max{0};                            // of kLate
  double share = 1;                                           // of kLate, above 0: 1 means that none may take longer
  std::chrono::nanoseconds grace = std::chrono::seconds(10);  // if the name was not seen until then, that is told

  bool operator==(const LiveCondition&) const = default;
};

// What has become of a condition.
struct ConditionChange {
  bool holds = false;
  // Of silence: for how many seconds nothing had happened. Of a rate: Hz. Of what is late: how many seconds the last
  // one took that was; of a callback that still runs, up to now.
  double figure = 0;
  // Labels of the processes whose publishers or nodes have the name, of kLate those whose subscriptions, nodes or
  // clients do: of those that run, or if none does, of all.
  std::vector<std::string> processes = {};
  double late = 0;  // of kLate: which part of what has happened in the window took too long

  bool operator==(const ConditionChange&) const = default;
};

// "2s", "500ms", "1.5s": as launch files write times.
std::string time_text(std::chrono::nanoseconds time);
// "31.2 ms": three digits, for people.
std::string short_time_text(std::chrono::nanoseconds time);
// The opposite of time_text(). Nullopt for anything else; units are us, ms, s and min, and one of them must be there.
std::optional<std::chrono::nanoseconds> parse_time_text(const std::string& text);

// What must be recorded for it beside publications, callbacks and the objects of nodes: nothing, "messages" as they are
// taken, or "calls" of services.
std::string needs_of(const LiveCondition& condition);

// "topic", "node", "service": the attribute that names the subject.
const char* name_of(LiveCondition::Subject subject);
// "on_silence of topic /scan for 2s", "on_rate of topic /scan below 5 Hz in 2s", "on_late of node /planner above 50ms".
std::string describe(const LiveCondition& condition);
// A sentence on the change: "no message on /scan for 2.03 s", "the silence of /scan is over after 3.4 s".
std::string sentence(const LiveCondition& condition, const ConditionChange& change);

}  // namespace tracing
