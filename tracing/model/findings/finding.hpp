// SPDX-License-Identifier: Apache-2.0
// What in a trace is most worth a look.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "tracing/model/analysis/results.hpp"

namespace tracing {

struct Finding {
  enum class Kind {
    kSlowestChain,
    kOverBudget,  // a chain that took longer than its budget
    kOverrun,     // a timer whose callback took longer than its period
    kWorstJitter,
    kBusiestExecutor,
    kDroppedMessages,
    kLongestWait,      // of messages for an executor
    kLongTail,         // a callback that sometimes takes many times as long as usually
    kUnanswered,       // requests
    kUnfinished,       // callbacks that were left by an exception
    kStarvedCallback,  // it waited for a processor
    kSlowestStart,
    kMemoryInActive,      // a lifecycle node asks for memory in its active state
    kDriftingTimer,       // it is usually called too late or too early, without having missed a period
    kDominatingCallback,  // it takes a large part of the time of its thread
  };
  Kind kind = Kind::kSlowestChain;
  double weight = 0;
  std::string subject;  // "/ping, timer 100 ms"
  std::string figures;  // "up to 7.80 ms off its period of 100 ms, 2 periods missed"
  // What it is about, if it is a callback (CallbackResult::id) or a topic.
  std::optional<std::uint32_t> callback = {};
  std::string topic = {};

  const char* name() const;   // for programs: "slowest_chain"
  const char* title() const;  // for people: "Slowest chain"

  static const Field<Finding> kFields[];
};

// In the order of Finding::Kind.
struct FindingWords {
  const char* name;
  const char* title;
};
inline constexpr FindingWords kFindingWords[] = {
    {"slowest_chain", "Slowest chain"},
    {"over_budget", "Over budget"},
    {"overrun", "Over period"},
    {"worst_jitter", "Worst jitter"},
    {"busiest_executor", "Busiest executor"},
    {"dropped_messages", "Dropped messages"},
    {"longest_wait", "Longest wait"},
    {"long_tail", "Rare slowness"},
    {"unanswered", "No response"},
    {"unfinished", "No end"},
    {"starved_callback", "No processor"},
    {"slowest_start", "Slowest start"},
    {"memory_in_active", "Memory in active"},
    {"drifting_timer", "Drifting timer"},
    {"dominating_callback", "Dominating"},
};
inline constexpr auto kFindingNames = [] {
  std::array<const char*, std::size(kFindingWords)> names{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = kFindingWords[i].name;
  }
  return names;
}();

inline const char* Finding::name() const {
  return kFindingWords[static_cast<std::size_t>(kind)].name;
}
inline const char* Finding::title() const {
  return kFindingWords[static_cast<std::size_t>(kind)].title;
}

inline constexpr Field<Finding> Finding::kFields[] = {
    {"kind", {&Finding::name, kFindingNames}, "one of these"},
    {"weight", &Finding::weight, "how much it is worth a look: 0 to 100"},
    {"subject", &Finding::subject, "what it is about: a text, which may change"},
    {"figures", &Finding::figures, "likewise"},
};

// At most one finding of each kind and of each callback, from the one most worth a look. A callback that dominates its
// executor is not named with the executor once more. Nothing is found in a system that is as it should be.
std::vector<Finding> find_worth_a_look(const TraceResults& results);

}  // namespace tracing
