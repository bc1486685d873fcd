// SPDX-License-Identifier: Apache-2.0
// What in a trace is most worth a look.
#pragma once

#include <cstdint>
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
    kMemoryInActive,  // a lifecycle node asks for memory in its active state
  };
  Kind kind = Kind::kSlowestChain;
  double weight = 0;    // 0 to 100: how much it is worth a look
  std::string subject;  // "/ping, timer 100 ms"
  std::string figures;  // "up to 7.80 ms off its period of 100 ms, 2 periods missed"
  // What it is about, if it is a callback (CallbackResult::id) or a topic.
  std::optional<std::uint32_t> callback = {};
  std::string topic = {};
};

// For programs: "slowest_chain"
const char* name_of(Finding::Kind kind);

// For people: "Slowest chain"
const char* title_of(Finding::Kind kind);

// At most one finding of each kind, from the one most worth a look.
std::vector<Finding> find_worth_a_look(const TraceResults& results);

}  // namespace tracing
