// SPDX-License-Identifier: Apache-2.0
// What in a trace is most worth a look.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tracing/model/analysis/results.hpp"
#include "tracing/model/finding_kinds/finding_kinds.hpp"

namespace tracing {

struct Finding {
  using Kind = FindingKind;
  Kind kind = Kind::kSlowestChain;
  double weight = 0;
  std::string subject;  // "/ping, timer 100 ms"
  std::string figures;  // "up to 7.80 ms off its period of 100 ms, 2 periods missed"
  std::string next;     // what to do: "shorten /ping, timer 100 ms (Ping::send())"
  // What it is about, if it is a callback (CallbackResult::id) or a topic.
  std::optional<std::uint32_t> callback = {};
  std::string topic = {};
  // The callbacks that have this trouble with it: what else is found of them has the same cause.
  std::vector<std::uint32_t> concerned = {};

  const char* name() const;   // for programs: "slowest_chain"
  const char* title() const;  // for people: "Slowest chain"

  static const Field<Finding> kFields[];
};

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
    {"next", &Finding::next, "what to do about it: likewise"},
};

// At most one finding of each kind and of each cause, from the one most worth a look: a callback that dominates its
// executor is not named with the executor once more, nor are those that wait for it. Nothing is found in a system that
// is as it should be. FindingWords::explanation has the reasoning.
std::vector<Finding> find_worth_a_look(const TraceResults& results);

}  // namespace tracing
