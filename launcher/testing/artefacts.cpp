// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/artefacts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "base/environment/own_prefix.hpp"
#include "base/text/quoted_text.hpp"
#include "launcher/crash/timed_command.hpp"
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

constexpr const char* kSession = "test";

// A text as the value of an attribute: `$` and `\\` mean something in launch files.
std::string attribute(const std::string& text) {
  std::string value;
  for (const char c : text) {
    if (c == '$' || c == '\\') {
      value += '\\';
    }
    value += c;
  }
  return as_xml_text(value);
}

}  // namespace

std::string trace_directory(const std::string& directory) {
  return directory + "/trace";
}

std::string own_trace_directory(const std::string& directory) {
  return directory + "/own_traces";
}

std::shared_ptr<const LaunchDescription> recorded(const LaunchDescription& description, const Registry& registry,
                                                  const std::string& directory,
                                                  const std::vector<std::string>& other_events) {
  std::string events = "ros2:* ros2_ext:*";
  for (const std::string& name : other_events) {
    events += " '" + name + "'";
  }
  // ROS 2's buffers of 32 KiB lose events when many processes start.
  const std::string text = fmt::format(
      "<launch><trace session-name=\"{}\" base-path=\"{}\" events-ust=\"{}\" "
      "subbuffer-size-ust=\"1048576\"/></launch>",
      kSession, attribute(trace_directory(directory)), attribute(events));
  const auto trace = parse_launch_description(std::make_shared<SourceFile>("launch test", text), registry);
  auto with_trace = std::make_shared<LaunchDescription>(description);
  with_trace->actions.insert(with_trace->actions.begin(), trace->actions.begin(), trace->actions.end());
  return with_trace;
}

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
