// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/checks/trace_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "launch_trace_testing/event_query.hpp"
#include "launch_trace_testing/expectations.hpp"
#include "launcher/testing/checks/trace_judges.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"

namespace launch {

namespace testing = launch_trace_testing;

namespace {

testing::Count count_of(std::uint64_t least, const std::optional<std::uint64_t>& most = {}) {
  return {least, most.value_or(std::numeric_limits<std::size_t>::max())};
}

testing::Bounds bounds_of(const TimeBounds& time) {
  return {time.least, time.most.value_or(std::chrono::nanoseconds::max()), time.percentile / 100};
}

std::size_t samples_of(const testing::Trace& trace, const ExpectedCallback& expected) {
  return static_cast<std::size_t>(
      std::count_if(trace.callbacks().begin(), trace.callbacks().end(), [&](const testing::CallbackRun& run) {
        return run.finished && (expected.node.empty() || run.node == expected.node) &&
               (expected.topic.empty() || run.topic == expected.topic) &&
               (expected.service.empty() || run.service == expected.service) &&
               run.symbol.find(expected.function) != std::string::npos;
      }));
}

// Verdicts have "expected: …" in their first line, "     saw: …" in the second, and a table below.
Failure failure_of(const std::string& message, const SourceRange& where, const std::string& verdict) {
  Failure failure{message, where};
  std::istringstream lines(verdict);
  constexpr std::string_view kExpected = "expected: ";
  constexpr std::string_view kSeen = "     saw:";
  constexpr std::string_view kNeeded = "needed: ";
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kExpected) && failure.expected.empty()) {
      failure.expected = line.substr(kExpected.size());
    } else if (line.starts_with(kSeen) && failure.seen.empty()) {
      failure.seen = line.substr(std::min(kSeen.size() + 1, line.size()));
    } else if (line.starts_with(kNeeded)) {
      failure.help = "record it with " + line.substr(kNeeded.size());
    } else {
      failure.evidence.push_back(line);
    }
  }
  failure.evidence_title = "the trace";
  return failure;
}

void check_condition(const ExpectedEvent& event) {
  if (event.condition.empty()) {
    return;
  }
  try {
    testing::EventQuery(event.name).where(event.condition);
  } catch (const testing::QueryError& error) {
    SourceRange place = event.condition_where;
    place.begin = std::min(place.begin + static_cast<std::uint32_t>(error.column()), place.end);
    throw LaunchError(error.reason(), place);
  }
}

// The processes of a trace, by the names that it tells.
std::vector<RecordedProcess> processes_of(const testing::Trace& trace) {
  std::map<std::int64_t, std::set<std::string>> names;
  for (const testing::Event& event : trace) {
    std::set<std::string>& of_process = names[event.vpid()];
    if (!event.procname().empty()) {
      of_process.insert(event.procname());
    }
    if (event.name() == "ros2:rcl_node_init") {
      const std::string& name = event.text("node_name");
      const std::string& name_space = event.text("namespace");
      of_process.insert(name);
      of_process.insert((name_space.ends_with('/') ? name_space : name_space + "/") + name);
    } else if (event.name() == "launch:exec") {
      const std::string& label = event.text("process");  // "talker-2"
      std::set<std::string>& of_started = names[event.number("pid")];
      of_started.insert(label);
      of_started.insert(label.substr(0, label.rfind('-')));
    }
  }
  std::vector<RecordedProcess> processes;
  for (auto& [pid, all] : names) {
    processes.push_back({{all.begin(), all.end()}, static_cast<pid_t>(pid)});
  }
  return processes;
}

}  // namespace

// Of traces that have been read.
class ReadTraceJudge {
 public:
  ReadTraceJudge(const std::string& directory, const std::vector<RecordedProcess>& processes)
      : directories_({directory}), processes_(processes), pids_(pids_of("")) {
    trace_ = testing::Trace(directories_,
                            {.accepts = [this](const testing::Event& event) { return pids_->contains(event.vpid()); }});
  }
  // All processes.
  explicit ReadTraceJudge(const std::vector<std::filesystem::path>& directories)
      : directories_(directories), trace_(directories), takes_names_from_trace_(true) {
    processes_ = processes_of(trace_);
  }

  const testing::Trace& trace() const { return trace_; }

  std::optional<Failure> judge(const Expectation& expectation) {
    where_ = expectation.where;
    process_ = expectation.process;
    if (std::optional<Failure> failure = check_name(expectation.process, expectation.process_where)) {
      return failure;
    }
    return std::visit([this](const auto& expected) { return check(expected); },
                      std::get<TraceExpectation>(expectation.what));
  }

 private:
  std::set<std::int64_t> pids_of(const std::string& name) const {
    std::set<std::int64_t> pids;
    for (const RecordedProcess& process : processes_) {
      if (name.empty() || has_name(process, name)) {
        pids.insert(process.pid);
      }
    }
    return pids;
  }

  // The kernel cuts the names of programs.
  bool has_name(const RecordedProcess& process, const std::string& name) const {
    constexpr std::size_t kLongest = 15;
    const auto fits = [&](const std::string& one) {
      return one == name || (takes_names_from_trace_ && one.size() == kLongest && one == name.substr(0, kLongest));
    };
    return std::any_of(process.names.begin(), process.names.end(), fits);
  }

  // In a finished trace a name may be none.
  std::optional<Failure> check_name(const std::string& name, const SourceRange& where) const {
    if (!takes_names_from_trace_ || name.empty() || !pids_of(name).empty()) {
      return std::nullopt;
    }
    std::vector<std::string> names;
    for (const RecordedProcess& process : processes_) {
      names.insert(names.end(), process.names.begin(), process.names.end());
    }
    Failure failure{fmt::format("no process of the trace is named '{}'", name), where};
    failure.help = did_you_mean(name, names);
    return failure;
  }

  std::optional<Failure> unless(const testing::Verdict& verdict, const std::string& message) const {
    if (verdict.holds) {
      return std::nullopt;
    }
    return failure_of(verdict.is_undecided ? "the trace does not tell whether this holds" : message, where_,
                      verdict.text);
  }

  testing::EventQuery query_of(const ExpectedEvent& expected, const std::string& process) const {
    testing::EventQuery query(expected.name);
    if (!expected.condition.empty()) {
      query.where(expected.condition);
    }
    if (!process.empty()) {
      query.that(fmt::format("in process '{}'", process),
                 [pids = pids_of(process)](const testing::Event& event) { return pids.contains(event.vpid()); });
    }
    return query;
  }

  std::optional<Failure> check(const ExpectedEventOrder& expected) const {
    std::vector<testing::EventQuery> queries;
    for (const ExpectedEventOrder::Step& step : expected.steps) {
      if (std::optional<Failure> failure = check_name(step.process, step.process_where)) {
        return failure;
      }
      queries.push_back(query_of(step.event, step.process));
    }
    return unless(testing::expect_order(trace_, queries), "the events do not come in this order");
  }

  std::optional<Failure> check(const ExpectedAllocations& expected) const {
    return judge_allocations(expected, analyse_chains(directories_, pids_, {}), where_);
  }

  std::optional<Failure> check(const ExpectedEvent& expected) const {
    return unless(testing::expect_count(trace_, query_of(expected, process_), count_of(expected.least, expected.most)),
                  fmt::format("the trace does not hold the events '{}' as expected", expected.name));
  }

  std::optional<Failure> check(const ExpectedDelivery& expected) const {
    const testing::Route route{expected.topic, expected.from, expected.to};
    if (std::optional<Failure> failure = unless(testing::expect_delivered(trace_, route, count_of(expected.least)),
                                                fmt::format("too few messages of '{}' have arrived", expected.topic))) {
      return failure;
    }
    return unless(testing::expect_all_delivered(trace_, route, expected.most_lost),
                  fmt::format("messages of '{}' were lost", expected.topic));
  }

  std::optional<Failure> check(const ExpectedLatency& expected) const {
    if (!expected.nodes.empty()) {
      return check_chain(expected);
    }
    return unless(testing::expect_delivered(trace_, {expected.topic, expected.from, expected.to},
                                            count_of(expected.least), bounds_of(expected.time)),
                  fmt::format("messages of '{}' do not take the time that is expected", expected.topic));
  }

  std::optional<Failure> check_chain(const ExpectedLatency& expected) const {
    const std::string chain = fmt::format("the chain {}", fmt::join(expected.nodes, " "));
    const tracing::TraceResults results = analyse_chains(directories_, pids_, {{"chain", expected.nodes, {}}});
    tracing::DurationSummary times;
    for (const tracing::ChainResult& result : results.ros2.chains) {
      if (result.name == "chain" && result.response.count > times.count) {
        times = result.response;
      }
    }
    if (times.count < expected.least) {
      Failure failure{fmt::format("{} was not gone through", chain), where_,
                      fmt::format("at least {} times", expected.least), fmt::format("{} times", times.count)};
      if (!trace_.doubts().empty() || trace_.lacks_middleware()) {
        explain_doubts(failure);
      }
      return failure;
    }
    const auto milliseconds = [](std::int64_t ns) { return static_cast<double>(ns) / 1e6; };
    const std::int64_t reached = percentile_of(times, expected.time.percentile);
    const bool is_late = expected.time.most && reached > expected.time.most->count();
    if (!is_late && times.min_ns >= expected.time.least.count()) {
      return std::nullopt;
    }
    return Failure{fmt::format("{} does not take the time that is expected", chain), where_,
                   is_late ? fmt::format("{:g} % of its runs take at most {:g} ms", expected.time.percentile,
                                         milliseconds(expected.time.most->count()))
                           : fmt::format("each run takes at least {:g} ms", milliseconds(expected.time.least.count())),
                   fmt::format("{} runs: least {:.3f} ms, median {:.3f} ms, {:g} % below {:.3f} ms, most {:.3f} ms",
                               times.count, milliseconds(times.min_ns), milliseconds(times.p50_ns),
                               expected.time.percentile, milliseconds(reached), milliseconds(times.max_ns))};
  }

  // A message that is missing in the chain may be one of those that are not known.
  void explain_doubts(Failure& failure) const {
    const auto is_open = [](const testing::MessageDoubts& doubts) { return doubts.taken > 0; };
    if (!trace_.lacks_middleware() && std::none_of(trace_.doubts().begin(), trace_.doubts().end(), is_open)) {
      return;
    }
    failure.message = "the trace does not tell whether this holds";
    failure.evidence_title = "the trace";
    failure.evidence.push_back("publications of messages that were taken can't be told" +
                               (trace_.tracetools().empty() ? "" : "; recorded by tracetools " + trace_.tracetools()));
    failure.help = "record it with tracetools 8.0 or later (ROS 2 Jazzy)";
  }

  std::optional<Failure> check(const ExpectedCallback& expected) const {
    const testing::CallbackChoice choice{expected.node, expected.topic, expected.service, expected.function, false};
    const testing::Verdict verdict = testing::expect_callback_duration(trace_, choice, bounds_of(expected.time));
    if (!verdict.holds) {
      return failure_of("callbacks do not take the time that is expected", where_, verdict.text);
    }
    const std::size_t runs = samples_of(trace_, expected);
    if (runs < expected.least) {
      return Failure{"there are too few runs of callbacks", where_, fmt::format("at least {}", expected.least),
                     fmt::format("{}", runs)};
    }
    return std::nullopt;
  }

  std::optional<Failure> check(const ExpectedTimer& expected) const { return judge_timer(expected, trace_, where_); }

  std::vector<std::filesystem::path> directories_;
  std::vector<RecordedProcess> processes_;
  std::optional<std::set<std::int64_t>> pids_;  // nullopt: all
  testing::Trace trace_;
  bool takes_names_from_trace_ = false;
  SourceRange where_;
  std::string process_;
};

void check_trace_expectation(const Expectation& expectation) {
  const auto* const trace = std::get_if<TraceExpectation>(&expectation.what);
  if (trace == nullptr) {
    return;
  }
  if (const auto* const event = std::get_if<ExpectedEvent>(trace)) {
    check_condition(*event);
  } else if (const auto* const order = std::get_if<ExpectedEventOrder>(trace)) {
    for (const ExpectedEventOrder::Step& step : order->steps) {
      check_condition(step.event);
    }
  }
}

namespace {

// What went wrong reading the traces.
std::vector<Failure> unreadable(const std::exception& error, const SourceRange& where) {
  // The second line is help.
  constexpr std::string_view kHelp = "\nhelp: ";
  const std::string text = error.what();
  const std::size_t help = text.find(kHelp);
  Failure failure{fmt::format("the trace can't be read: {}", text.substr(0, help)), where};
  if (help != std::string::npos) {
    failure.help = text.substr(help + kHelp.size());
  }
  return {std::move(failure)};
}

std::vector<Failure> judge_all(ReadTraceJudge& judge, const std::vector<Expectation>& expectations,
                               const SourceRange& where) {
  std::vector<Failure> failures;
  if (const testing::Verdict loss = testing::expect_no_loss(judge.trace()); !loss.holds) {
    failures.push_back(
        failure_of(judge.trace().empty() ? "the trace is empty" : "the trace is not whole", where, loss.text));
  }
  for (const Expectation& expectation : expectations) {
    if (std::optional<Failure> failure = judge.judge(expectation)) {
      failures.push_back(std::move(*failure));
    }
  }
  return failures;
}

}  // namespace

class TraceJudge::Parts {
 public:
  explicit Parts(std::vector<std::filesystem::path> in) : directories(std::move(in)) {}
  std::vector<std::filesystem::path> directories;
  std::optional<ReadTraceJudge> judge;  // when the traces have been read
};

TraceJudge::TraceJudge(const std::vector<std::filesystem::path>& directories)
    : parts_(std::make_unique<Parts>(directories)) {}
TraceJudge::~TraceJudge() = default;

std::vector<Failure> TraceJudge::judge(const std::vector<Expectation>& expectations, const SourceRange& where) {
  try {
    if (!parts_->judge) {
      parts_->judge.emplace(parts_->directories);
    }
    return judge_all(*parts_->judge, expectations, where);
  } catch (const testing::TraceError& error) {
    return unreadable(error, where);
  } catch (const tracing::TraceReadError& error) {
    return unreadable(error, where);
  }
}

std::vector<Failure> judge_trace(const std::vector<Expectation>& expectations, const std::string& directory,
                                 const std::vector<RecordedProcess>& processes, const SourceRange& where) {
  try {
    ReadTraceJudge judge(directory, processes);
    return judge_all(judge, expectations, where);
  } catch (const testing::TraceError& error) {
    return unreadable(error, where);
  } catch (const tracing::TraceReadError& error) {
    return unreadable(error, where);
  }
}

}  // namespace launch
