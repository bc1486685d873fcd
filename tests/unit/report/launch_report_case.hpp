// SPDX-License-Identifier: Apache-2.0
// Runs the program `launch-report`, and what it printed.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"

namespace tracing {

struct Outcome {
  int exit_code;
  std::string out;
  std::string err;
};

inline std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

inline Outcome launch_report(const std::string& arguments) {
  const testing::TemporaryDirectory directory;
  const std::filesystem::path out = directory.path() / "out";
  const std::filesystem::path err = directory.path() / "err";
  const std::string command = std::string(LAUNCH_REPORT) + " " + arguments + " >" + out.string() + " 2>" + err.string();
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
}

inline void write_ping_pong(testing::TraceWriter& writer) {
  for (const auto& [time, thread, event] : testing::ping_pong_sequence()) {
    writer.write(thread.vpid == testing::kPing.vpid ? 0 : 1, time, thread, event);
  }
}

class LaunchReport : public ::testing::Test {
 protected:
  testing::TemporaryDirectory directory_;
  std::string path_ = directory_.path().string();
};

}  // namespace tracing
