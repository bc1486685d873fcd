// SPDX-License-Identifier: Apache-2.0
// What `launch test` says to a person: a line for each test, what has failed, and on a terminal what runs now.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "launcher/testing/test_queue.hpp"

namespace launch {

class TestReport final : public QueueObserver {
 public:
  // The stream must outlive the report.
  explicit TestReport(std::FILE* stream);

  void on_progress(std::size_t ended, std::size_t all, const std::vector<std::string>& running) override;
  void on_result(const TestResult& result) override;
  // Of a result that was told before.
  void on_shrunk(const TestResult& result);
  // "3 tests: 2 passed, 1 failed, in 1.2 s", and the names of those that have failed.
  void finish(const std::vector<TestResult>& results, std::size_t all, double seconds, bool interrupted);

 private:
  void clear_line();

  std::FILE* stream_;
  bool has_progress_;
  bool has_colour_;
  bool has_line_ = false;
  std::size_t failed_ = 0;
  std::size_t flaky_ = 0;
};

}  // namespace launch
