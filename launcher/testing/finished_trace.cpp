// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/finished_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <string>

#include "launcher/testing/checks/trace_check.hpp"
#include "launcher/testing/failure.hpp"
#include "launcher/visit/test_request.hpp"

namespace launch {

namespace {

constexpr const char* kHelp =
    "--skip-others leaves out what a trace does not tell; without --trace, everything is judged";

// What the expectation is about.
std::string subject_of(const Expectation& expectation) {
  struct Subject {
    std::string operator()(const ExpectedExit&) const { return "how processes end"; }
    std::string operator()(const ExpectedOutput&) const { return "what processes write"; }
    std::string operator()(const ExpectedSequence&) const { return "what processes write"; }
    std::string operator()(const ExpectedGraph&) const { return "what the ROS graph showed"; }
    std::string operator()(const ExpectedMessages&) const { return "what messages hold"; }
    std::string operator()(const ExpectedResources&) const { return "what processes use"; }
    std::string operator()(const TraceExpectation&) const { return "its events"; }
  };
  return std::visit(Subject(), expectation.what);
}

Failure not_told(const std::string& what, const SourceRange& where) {
  Failure failure{what, where};
  failure.help = kHelp;
  return failure;
}

class Judgement {
 public:
  Judgement(TraceJudge& judge, const FinishedTrace& trace) : judge_(judge), trace_(trace) {}

  void judge(const TestRequest& test, TestResult& result) {
    std::vector<Expectation> of_trace;
    std::vector<Failure> failures;
    for (const Expectation& expectation : test.expectations) {
      if (std::holds_alternative<TraceExpectation>(expectation.what)) {
        of_trace.push_back(expectation);
      } else {
        failures.push_back(
            not_told(fmt::format("a finished trace does not tell {}", subject_of(expectation)), expectation.where));
      }
    }
    for (const FaultRequest& fault : test.faults) {
      failures.push_back(not_told("a fault can't be applied to a finished trace", fault.where));
    }
    if (trace_.skips_others) {
      result.not_judged = failures.size();
      failures.clear();
    }
    if (of_trace.empty() && failures.empty()) {
      failures.push_back({"the test expects nothing that a finished trace tells", test.where});
    }
    const std::vector<Failure> found = of_trace.empty() ? std::vector<Failure>() : judge_.judge(of_trace, test.where);
    result.met = of_trace.size() - std::min(of_trace.size(), found.size());
    failures.insert(failures.end(), found.begin(), found.end());
    std::transform(failures.begin(), failures.end(), std::back_inserter(result.failures),
                   [](const Failure& failure) { return as_text(failure); });
  }

 private:
  TraceJudge& judge_;
  const FinishedTrace& trace_;
};

}  // namespace

std::vector<TestResult> judge_finished_trace(const std::vector<TestCase>& tests, const Registry& registry,
                                             const Environment& environment, const LaunchArguments& arguments,
                                             const FinishedTrace& trace, QueueObserver& observer) {
  using Clock = std::chrono::steady_clock;
  TraceJudge judge(trace.directories);
  Judgement judgement(judge, trace);
  std::vector<TestResult> results;
  for (const TestCase& test : tests) {
    const Clock::time_point begin = Clock::now();
    TestResult result{.file = test.file, .name = test.name, .line = test.line};
    judgement.judge(request_of(test, registry, environment, arguments), result);
    result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    observer.on_result(result);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace launch
