// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/session/trace_reading.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace trace_test {

using test_support::run_command;

ReadTrace read_trace(const std::string& directory) {
  ReadTrace trace;
  const auto result = run_command({"babeltrace2", directory});
  if (result.exit_code != 0) {
    trace.complaints = "exit code " + std::to_string(result.exit_code) + "\n";
  }

  // "[time] (+delta) host ros2:rcl_init: { … }"
  std::istringstream out(result.out);
  for (std::string line; std::getline(out, line);) {
    const std::size_t end = line.find(": {");
    const std::size_t begin = line.rfind(' ', end) + 1;
    if (end != std::string::npos) {
      ++trace.events[line.substr(begin, end - begin)];
    }
    trace.lines.push_back(line);
  }
  const std::string discarded = "Tracer discarded ";
  std::istringstream err(result.err);
  for (std::string line; std::getline(err, line);) {
    const std::size_t found = line.find(discarded);
    if (found != std::string::npos) {
      const bool packets = line.find(" packet", found) < line.find(" between", found);
      (packets ? trace.lost_packets : trace.discarded) += std::stoull(line.substr(found + discarded.size()));
    } else if (line.find("Tracer may have discarded ") != std::string::npos) {
      ++trace.unknown_losses;
    } else {
      trace.complaints += line + "\n";
    }
  }
  return trace;
}

std::string listed_sessions() {
  const auto result = run_command({"lttng", "list"});
  if (result.exit_code != 0) {
    return "lttng list failed: " + result.err;
  }
  return result.out.find("Currently no available recording session") != std::string::npos ? "" : result.out;
}

TracedApp::TracedApp(int count, int bytes)
    : process_({.argv = {TRACED_APP, std::to_string(count), std::to_string(bytes)},
                // On a busy machine the session daemon may take longer than LTTng's three seconds to register it.
                .environment = {{"LTTNG_UST_REGISTER_TIMEOUT", "-1"}}}) {
  EXPECT_TRUE(process_.wait_for_output("fired\n"));
}

void TracedApp::fire_again() {
  std::string expected;
  for (++fired_; static_cast<int>(expected.size()) < fired_ * 6;) {
    expected += "fired\n";
  }
  process_.write("\n");
  EXPECT_TRUE(process_.wait_for_output(expected));
}

void TracedApp::end() {
  process_.close_input();
  EXPECT_EQ(process_.wait().exit_code, 0);
}

}  // namespace trace_test
