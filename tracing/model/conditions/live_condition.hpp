// SPDX-License-Identifier: Apache-2.0
// A condition on what nodes do while they run: plain data.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tracing {

struct LiveCondition {
  enum class Kind {
    kSilence,  // nothing has happened for `window`
    kRate,     // so much, or so little, has happened in `window`
    kLate,     // of what has happened in `window`, less than `share` took no longer than `max`
    kLoss,     // of the messages for subscriptions in `window`, less than `share` arrived
    // Of a process:
    kMemory,     // it has had more than `above` bytes of memory for `window`
    kGrowth,     // it has `above` bytes more than at some time in `window`
    kProcessor,  // it has used more than the share `above` of a processor in `window`
  };
  enum class Subject {
    kTopic,    // something happens when a message is published; late: it takes until the begin of a callback for it
    kNode,     // something happens when a callback of the node ends; late: it takes as long as the callback runs
    kService,  // late only: from the request of a client until it takes the response
    kAction,   // late only: from the request of a client for the result until it takes that
    kTimer,    // late only: from when a timer of the node is due until the begin of its callback
    kProcess,  // a process by its name or that of its node
    kChain,    // late only: from the begin of a callback of the first node to the end of one of the last node
  };

  Kind kind = Kind::kSilence;
  Subject subject = Subject::kTopic;
  std::string name =
      {};  // the full name of the topic, node, service or action; of a process its name; of a chain "/first -> /last"
  std::chrono::nanoseconds window{0};
  std::optional<double> below = std::nullopt;  // of kRate: one of both, in Hz
  std::optional<double> above = std::nullopt;  // or, of a process, bytes or a share of a processor
  std::chrono::nanoseconds max{0};             // of kLate
  double share = 1;  // of kLate and kLoss, above 0: 1 means that none may take longer, or be lost
  std::chrono::nanoseconds grace = std::chrono::seconds(10);  // if the name was not seen until then, that is told

  bool operator==(const LiveCondition&) const = default;
};

// What has become of a condition.
struct ConditionChange {
  bool holds = false;
  // Of silence: for how many seconds nothing had happened. Of a rate: Hz. Of what is late: how many seconds the last
  // one took that was; of a callback that still runs, up to now. Of losses: how many there were in the window.
  // Of a process: bytes, or the share of a processor.
  double figure = 0;
  // Labels of the processes whose publishers or nodes have the name, of kLate and kLoss those whose subscriptions,
  // nodes or clients do: of those that run, or if none does, of all.
  std::vector<std::string> processes = {};
  double late = 0;  // of kLate: which part of what has happened in the window took too long; of kLoss: was lost

  bool operator==(const ConditionChange&) const = default;
};

// "2s", "500ms", "1.5s": as launch files write times.
std::string time_text(std::chrono::nanoseconds time);
// "31.2 ms": three digits, for people.
std::string short_time_text(std::chrono::nanoseconds time);
// The opposite of time_text(). Nullopt for anything else; units are us, ms, s and min, and one of them must be there.
std::optional<std::chrono::nanoseconds> parse_time_text(const std::string& text);

// Nothing must be recorded for it.
inline bool is_of_process(const LiveCondition& condition) {
  return condition.subject == LiveCondition::Subject::kProcess;
}

// What must be recorded for it beside publications, callbacks and the objects of nodes: nothing, "messages" as they are
// taken, "losses" of messages, or "calls" of services.
std::string needs_of(const LiveCondition& condition);

// "topic", "node", "service" and so on: the attribute that names the subject.
const char* name_of(LiveCondition::Subject subject);
// Of what is recorded.
inline constexpr std::array kRecordedSubjects = {LiveCondition::Subject::kTopic,   LiveCondition::Subject::kNode,
                                                 LiveCondition::Subject::kService, LiveCondition::Subject::kAction,
                                                 LiveCondition::Subject::kTimer,   LiveCondition::Subject::kChain};

// The names of the nodes in that of a chain, "/camera -> /fusion -> /brake": at least two, which may have `*` in them.
// Nullopt for anything else.
std::optional<std::vector<std::string>> nodes_of_chain(std::string_view chain);
std::string chain_of_nodes(const std::vector<std::string>& nodes);
// "on_silence of topic /scan for 2s", "on_rate of topic /scan below 5 Hz in 2s", "on_late of node /planner above 50ms".
std::string describe(const LiveCondition& condition);
// A sentence on the change: "no message on /scan for 2.03 s", "the silence of /scan is over after 3.4 s".
std::string sentence(const LiveCondition& condition, const ConditionChange& change);

}  // namespace tracing
