// SPDX-License-Identifier: Apache-2.0
// Judges what a test expects of the trace of its run.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "launcher/testing/failure.hpp"
#include "launcher/visit/test_request.hpp"

namespace launch {

// A process of the run, by its label and its names (process_table.hpp).
struct RecordedProcess {
  std::vector<std::string> names;
  pid_t pid = -1;
};

// Throws LaunchError at its place for a mistake in the expectation that only this code can find.
void check_trace_expectation(const Expectation& expectation);

// Judges expectations of finished traces, which are read once. All that is in them counts. A process has the names that
// the traces tell: those of its program and its nodes, and that of the launch file if a launcher has recorded it.
class TraceJudge {
 public:
  explicit TraceJudge(const std::vector<std::filesystem::path>& directories);
  ~TraceJudge();

  // As judge_trace() below.
  std::vector<Failure> judge(const std::vector<Expectation>& expectations, const SourceRange& where);

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

// Reads the traces in and below the directory, and judges each expectation of the trace. Only the events of these
// processes count. Every trace is expected to be there, and to have lost nothing; `where` is the place of the test.
std::vector<Failure> judge_trace(const std::vector<Expectation>& expectations, const std::string& directory,
                                 const std::vector<RecordedProcess>& processes, const SourceRange& where);

}  // namespace launch
