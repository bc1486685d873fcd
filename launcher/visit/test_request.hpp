// SPDX-License-Identifier: Apache-2.0
// What a <test> of a launch file asks for. It is plain data: nothing has been checked yet.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "launcher/language/message_watch.hpp"
#include "launcher/language/output_pattern.hpp"
#include "launcher/language/readiness_condition.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/visit/fault_request.hpp"
#include "launcher/visit/trace_expectation.hpp"

namespace launch {

// A line that a process should write.
struct ExpectedLine {
  OutputPattern pattern;
  std::string text;  // a part of the line, as it stands; empty: any

  bool matches(OutputStream stream, std::string_view line) const {
    return pattern.matches(stream, line) && (text.empty() || line.find(text) != std::string_view::npos);
  }
  // "a line with 'ready' on stdout", "a line that matches 'rate: \d+'", "any line".
  std::string describe() const;
};

// How a process ends.
struct ExpectedExit {
  ExitCodeFilter code;
  bool after_shutdown = false;  // the end of the test ends it; else it ends by itself
};
struct ExpectedOutput {
  ExpectedLine line;
  std::uint64_t least = 1;
  std::optional<std::uint64_t> most;  // nullopt: any number
  bool after_shutdown = false;        // only lines that come while the end of the test ends the process
};
// Each of the lines later than the one before.
struct ExpectedSequence {
  std::vector<ExpectedLine> lines;
};
struct ExpectedGraph {
  std::shared_ptr<ReadinessCondition> condition;
  bool absent = false;
};
struct ExpectedMessages {
  std::shared_ptr<MessageWatch> watch;
  std::uint64_t least = 1;
  std::optional<std::uint64_t> most;  // nullopt: any number
  std::optional<double> least_rate;   // messages in a second, from the first to the last one
  std::optional<double> most_rate;
  bool without_publisher = false;  // `most` holds as well where nobody publishes
};
// The most that a process may have used when it ends.
struct ExpectedResources {
  std::optional<std::uint64_t> memory;  // bytes in use at the same time
  std::optional<Duration> processor_time;
};

struct Expectation {
  std::variant<ExpectedExit, ExpectedOutput, ExpectedSequence, ExpectedGraph, ExpectedMessages, ExpectedResources,
               TraceExpectation>
      what;
  std::string process;             // a name (process_table.hpp); empty: every process
  SourceRange process_where;       // the place of that name
  std::optional<Duration> within;  // from the begin of the test
  SourceRange where;
};

struct TestRequest {
  std::string name;
  Duration timeout{0};
  std::optional<Duration> duration;  // the system runs so long at least
  std::vector<Expectation> expectations;
  bool has_actions = false;          // beside its expectations, faults among them
  std::vector<FaultRequest> faults;  // only if its actions were visited
  SourceRange where;
  SourceRange name_where;

  // Whether it expects something of the trace, so that its run is recorded.
  bool is_traced() const {
    return std::any_of(expectations.begin(), expectations.end(), [](const Expectation& expectation) {
      return std::holds_alternative<TraceExpectation>(expectation.what);
    });
  }
};

}  // namespace launch
