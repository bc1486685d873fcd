// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/artefacts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "base/environment/own_prefix.hpp"
#include "launcher/crash/timed_command.hpp"
#include "launcher/testing/trace_session.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

namespace fs = std::filesystem;

namespace {

// A trace of hundreds of megabytes takes so long on a busy machine. The result of the test waits for it.
constexpr std::chrono::seconds kLongestReport{60};

void write_report(const fs::path& trace, const std::vector<pid_t>& processes) {
  const std::string output = (trace / "report.txt").string();
  const TimedCommand report =
      run_timed({own_library_file("launch-report"), trace.string(), "--html", (trace / "report.html").string(),
                 fmt::format("--processes={}", fmt::join(processes, ","))},
                output, kLongestReport);
  if (report.in_time && report.exit_code == 0) {
    std::error_code ignored;
    fs::remove(output, ignored);
  }
}

}  // namespace

std::string crash_directory(const std::string& directory) {
  return directory + "/crashes";
}

void expect_no_crash_bundle(const std::vector<Expectation>& expectations, ProcessSpec& spec) {
  const std::vector<std::string> names = names_of(spec);
  for (const Expectation& expectation : expectations) {
    const auto* const exit = std::get_if<ExpectedExit>(&expectation.what);
    const bool is_meant = exit != nullptr && std::find(names.begin(), names.end(), expectation.process) != names.end();
    if (is_meant && (!exit->code.is_listed() || exit->code.codes() != std::vector<int>{0})) {
      spec.crash_directory.clear();
      spec.limits.core_files = false;
    }
  }
}

void write_reports(const std::string& directory, const std::vector<pid_t>& processes) {
  std::error_code none;
  if (processes.empty()) {
    return;
  }
  for (const std::string& traces : {trace_directory(directory), own_trace_directory(directory)}) {
    for (const fs::directory_entry& trace : fs::directory_iterator(traces, none)) {
      if (trace.is_directory(none)) {
        write_report(trace.path(), processes);
      }
    }
  }
}

}  // namespace launch
