// SPDX-License-Identifier: Apache-2.0
// How the processes of a launch started, and the whole system.
#pragma once

#include "tracing/model/analysis/results/overview.hpp"

namespace tracing {

// A process that the launcher started. Times count from exec_ns; nullopt: it did not happen, or is not in the trace.
struct StartResult {
  std::int64_t vpid = 0;
  std::string process;
  std::string file;
  std::int64_t line = 0;
  std::int64_t exec_ns = 0;
  std::optional<std::int64_t> node_after_ns;
  std::optional<std::int64_t> ready_after_ns;
  std::optional<ProcessIndex> place = {};  // nullopt: it recorded nothing
  std::optional<std::int64_t> spawn_ns = {};
  std::optional<std::int64_t> init_after_ns = {};
  std::optional<std::int64_t> callback_after_ns = {};
  std::optional<std::int64_t> publication_after_ns = {};

  static const Field<StartResult> kFields[];
};
inline constexpr Field<StartResult> StartResult::kFields[] = {
    {"vpid", &StartResult::vpid, "", trait::kNotOnPage},
    {"process", &StartResult::process, "the launcher's name for it: `talker-1`", trait::kNotOnPage},
    {"file", &StartResult::file, "the launch file that asked for it"},
    {"line", &StartResult::line, "in this file"},
    {"exec_ns", &StartResult::exec_ns, "when its program began to run", trait::kTime},
    {"node_after_ns", &StartResult::node_after_ns, "from then to its first `rcl_node_init`"},
    {"ready_after_ns", &StartResult::ready_after_ns,
     "to the first event of an executor after that; at this time everything exists that the program makes before it "
     "spins"},
    {"spawn_ns", &StartResult::spawn_ns, "when the launcher began to start it", trait::kTime},
    {"init_after_ns", &StartResult::init_after_ns, "from `exec_ns` to `rcl_init`"},
    {"callback_after_ns", &StartResult::callback_after_ns, "to its first callback"},
    {"publication_after_ns", &StartResult::publication_after_ns,
     "to its first message on any topic but `/rosout` and `/parameter_events`"},
};

// A part of the way from the begin of the launch until every process was ready.
struct StartStep {
  std::string process;
  std::string what;
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;

  static const Field<StartStep> kFields[];
};
inline constexpr Field<StartStep> StartStep::kFields[] = {
    {"process", &StartStep::process, "`talker-1`; `\"\"`: the launcher itself"},
    {"what", &StartStep::what, "`load a.launch.xml`, `until rcl_init`"},
    {"begin_ns", &StartStep::begin_ns, "", trait::kTime},
    {"end_ns", &StartStep::end_ns, "", trait::kTime},
};

// The steps that the process which was ready last had to wait for, in the order of time and without gaps. Had one of
// them taken less time, the system would have been ready earlier.
struct StartupResult {
  std::int64_t begin_ns = 0;  // of the first step of the launcher
  std::int64_t ready_ns = 0;  // the last process was ready
  std::vector<StartStep> critical_path;
};

}  // namespace tracing
