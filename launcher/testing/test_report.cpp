// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/test_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "base/terminal/terminal.hpp"

namespace launch {

TestReport::TestReport(std::FILE* stream)
    : stream_(stream),
      has_progress_(takes_control_sequences(::fileno(stream))),
      has_colour_(shows_colour(::fileno(stream))) {}

void TestReport::on_progress(std::size_t ended, std::size_t all, const std::vector<std::string>& running) {
  if (!has_progress_) {
    return;
  }
  clear_line();
  if (running.empty()) {
    return;
  }
  std::string text =
      fmt::format("[{}{}]{} {}", ended, all == std::numeric_limits<std::size_t>::max() ? "" : fmt::format("/{}", all),
                  failed_ == 0 ? "" : fmt::format(" {} failed,", failed_), fmt::join(running, ", "));
  text.resize(std::min(text.size(), terminal_columns(::fileno(stream_)) - 1));
  fmt::print(stream_, "{}", text);
  std::fflush(stream_);
  has_line_ = true;
}

void TestReport::clear_line() {
  if (has_line_) {
    fmt::print(stream_, "\r\x1b[K");
    has_line_ = false;
  }
}

void TestReport::on_result(const TestResult& result) {
  clear_line();
  const char* const word = result.passed() ? "PASS" : "FAIL";
  const char* const colour = !has_colour_ ? "" : result.passed() ? "\x1b[32m" : "\x1b[31m";
  const std::string attempts = result.attempts == 1 ? "" : fmt::format("  ({} attempts)", result.attempts);
  const std::string faults = result.faults.empty() ? "" : fmt::format("  ({})", fault_count_text(result));
  fmt::print(stream_, "{}{}{}  {}  {:.2f} s{}{}\n", colour, word, has_colour_ ? "\x1b[0m" : "", result.title(),
             result.seconds, faults, attempts);
  if (result.passed()) {
    if (!result.earlier.empty()) {
      ++flaky_;
      fmt::print(stream_, "      = first attempt: {}\n", result.earlier);
    }
    std::fflush(stream_);
    return;
  }
  ++failed_;
  for (const TestFailure& failure : result.failures) {
    fmt::print(stream_, "{}", failure.text);
  }
  if (result.not_judged > 0) {
    fmt::print(stream_, "      = not judged: {} expectation{}\n", result.not_judged, result.not_judged == 1 ? "" : "s");
  }
  fmt::print(stream_, "{}", seed_text(result));
  if (!result.directory.empty()) {
    fmt::print(stream_, "      = files: {}\n", result.directory);
  }
  std::fflush(stream_);
}

void TestReport::on_shrunk(const TestResult& result) {
  clear_line();
  fmt::print(stream_, "SHRUNK  {}\n{}", result.title(), shrunk_text(result));
  std::fflush(stream_);
}

void TestReport::finish(const std::vector<TestResult>& results, std::size_t all, double seconds, bool interrupted) {
  clear_line();
  const std::size_t passed = results.size() - failed_;
  fmt::print(stream_, "\n{} test{}: {} passed{}{}{}, in {:.1f} s\n", all, all == 1 ? "" : "s", passed,
             flaky_ == 0 ? "" : fmt::format(" ({} only after a retry)", flaky_),
             failed_ == 0 ? "" : fmt::format(", {} failed", failed_),
             results.size() == all ? "" : fmt::format(", {} not run", all - results.size()), seconds);
  if (interrupted) {
    fmt::print(stream_, "interrupted\n");
  }
  if (failed_ > 0 && results.size() > 1) {
    for (const TestResult& result : results) {
      if (!result.passed()) {
        fmt::print(stream_, "FAIL  {}\n", result.title());
      }
    }
  }
  std::fflush(stream_);
}

}  // namespace launch
