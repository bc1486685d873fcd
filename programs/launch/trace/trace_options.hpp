// SPDX-License-Identifier: Apache-2.0
// The command line of `launch trace`, parsed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

enum class TraceVerb {
  kInteractive,
  kStart,
  kPause,
  kResume,
  kStop,
  kRecordSnapshot,
  kSave,
  kLoad,
  kList,
  kStatus,
  kEvents,
  kCalibrate
};

struct TraceOptions {
  TraceVerb verb = TraceVerb::kInteractive;
  std::string command = "launch trace";  // with the verb: "launch trace start"
  TraceConfig config;         // of the verbs without session options only the name is filled in; status: empty for all
  bool list_names = false;    // -l
  bool dual_session = false;  // -d
  std::optional<std::int64_t> created_since;  // stop: leave a session alone that is older, seconds since the epoch
  std::string directory;                      // of the file that save writes and load reads; empty: LTTng's own
};

// What the parser wants printed in place of running something, with its line ends: help on stdout (exit code 0), or an
// error on stderr (2).
struct ParserMessage {
  int exit_code = 0;
  std::string text;
};

// Whether it is a verb that takes the name of a session that exists.
bool acts_on_session(std::string_view verb);

std::variant<TraceOptions, ParserMessage> parse_trace_options(const std::vector<std::string>& arguments);

}  // namespace tracing
