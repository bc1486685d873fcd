#include "tests/unit/session/trace_reading.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <sstream>

namespace trace_test {

using test_support::run_command;

ReadTrace read_trace(const std::string& directory) {
  ReadTrace trace;
  const auto result = run_command({"babeltrace2", directory});
  if (result.exit_code != 0) trace.complaints = "exit code " + std::to_string(result.exit_code) + "\n";

  std::istringstream out(result.out);
  const std::regex event_name(R"( (ros2:\w+|lttng_ust\w*:\w+): )");
  for (std::string line; std::getline(out, line);) {
    std::smatch match;
    if (std::regex_search(line, match, event_name)) ++trace.events[match[1]];
    trace.lines.push_back(line);
  }
  std::istringstream err(result.err);
  const std::regex discarded(R"(Tracer discarded (\d+) events? )");
  for (std::string line; std::getline(err, line);) {
    std::smatch match;
    if (std::regex_search(line, match, discarded)) {
      trace.discarded += std::stoull(match[1]);
    } else {
      trace.complaints += line + "\n";
    }
  }
  return trace;
}

std::string listed_sessions() {
  const auto result = run_command({"lttng", "list"});
  if (result.exit_code != 0) return "lttng list failed: " + result.err;
  return result.out.find("Currently no available recording session") != std::string::npos ? "" : result.out;
}

TracedApp::TracedApp(int count, int bytes)
    : process_({.argv = {TRACED_APP, std::to_string(count), std::to_string(bytes)}}) {
  EXPECT_TRUE(process_.wait_for_output("fired\n"));
}

void TracedApp::fire_again() {
  std::string expected;
  for (++fired_; static_cast<int>(expected.size()) < fired_ * 6;) expected += "fired\n";
  process_.write("\n");
  EXPECT_TRUE(process_.wait_for_output(expected));
}

void TracedApp::end() {
  process_.close_input();
  EXPECT_EQ(process_.wait().exit_code, 0);
}

}  // namespace trace_test
