// SPDX-License-Identifier: Apache-2.0
// Callbacks that cause one another by messages. The times are explained in chain_tracker.hpp.
#pragma once

#include "tracing/model/analysis/results/overview.hpp"

namespace tracing {

struct ChainResult {
  struct Step {
    ProcessIndex process = 0;
    std::string node;
    std::string callback;
    std::uint32_t callback_id = 0;  // as CallbackResult::id
    std::string topic;              // empty at the begin
    DurationSummary until_publish;
    DurationSummary transfer;
    DurationSummary transport;
    DurationSummary executor;
    DurationSummary take;

    bool has_message() const { return !topic.empty(); }

    static const Field<Step> kFields[];
  };
  std::vector<Step> steps;
  std::string name;
  std::optional<std::int64_t> budget_ns;
  std::uint64_t over_budget = 0;
  DurationSummary last_callback;
  DurationSummary response;
  DurationSummary reaction;
  DurationSummary age;
  std::int64_t longest_begin_ns = 0;
  std::int64_t longest_end_ns = 0;
  bool is_loop = false;
  bool estimated = false;
  bool doubtful = false;
  std::uint32_t path = 0;  // PathId: index in ChainTracker::paths()

  static const Field<ChainResult> kFields[];
};
inline constexpr Field<ChainResult::Step> ChainResult::Step::kFields[] = {
    {"process", &Step::process, "index in `processes`", trait::kProcess},
    {"node", &Step::node, "", trait::kNotOnPage},
    {"callback", &Step::callback, "what calls it: `timer 100 ms`, `subscription /ping`", trait::kNotOnPage},
    {"topic", &Step::topic, "that led here; this and what follows: in all steps but the first one", trait::kNotOnPage,
     &Step::has_message},
    {"until_publish", &Step::until_publish, "from the begin of the callback before to its publication", trait::kPlain,
     &Step::has_message},
    {"transfer", &Step::transfer, "from there to the begin of this callback; its parts follow", trait::kNotOnPage,
     &Step::has_message},
    {"transport", &Step::transport, "on the way; `executor` is part of it if that is not known", trait::kPlain,
     &Step::has_message},
    {"executor", &Step::executor, "the wait for the executor; `count` is 0 if the executor records no waits",
     trait::kPlain, &Step::has_message},
    {"take", &Step::take, "from `rmw_take` on", trait::kPlain, &Step::has_message},
};
// JSON has the steps between the name and the budget.
inline constexpr Field<ChainResult> ChainResult::kFields[] = {
    {"name", &ChainResult::name, "given by the user; `\"\"`: the chain was found"},
    {"budget_ns", &ChainResult::budget_ns, "for the response; `null` without a budget"},
    {"over_budget", &ChainResult::over_budget, "responses that took longer"},
    {"last_callback", &ChainResult::last_callback, "duration of the last callback"},
    {"response", &ChainResult::response, "from an input to the first output; `docs/report.md` explains the times"},
    {"reaction", &ChainResult::reaction, "to the same output from the input before"},
    {"age", &ChainResult::age, "from an input to the last output"},
    {"longest_begin_ns", &ChainResult::longest_begin_ns, "of the longest response", trait::kTime | trait::kNotOnPage},
    {"longest_end_ns", &ChainResult::longest_end_ns, "likewise", trait::kTime},
    {"is_loop", &ChainResult::is_loop, "the last callback is in the chain already"},
    {"estimated", &ChainResult::estimated, "a topic of the chain has `estimated` messages"},
    {"doubtful", &ChainResult::doubtful, "a process of the chain may have lost events"},
};

}  // namespace tracing
