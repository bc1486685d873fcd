// SPDX-License-Identifier: Apache-2.0
// Starts a system for a test, records it, and gives its trace.
//
//   LaunchRun run({.file = "system.launch.xml", .arguments = {{"count", "2"}}});
//   const RunResult result = run.wait();     // until it ends by itself; run.stop() ends it
//   const Trace trace = run.trace();
//
// Each run has what no other run on the machine has: a directory of its own for logs, generated files and traces, an
// LTTng session, and a ROS domain. Its trace holds the events of its own processes alone, whatever else runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "launch_trace_testing/trace.hpp"

namespace launch_trace_testing {

// A program with its arguments. The first word is a path, or a name that is looked up in PATH.
using Program = std::vector<std::string>;

struct RunOptions {
  // A launch file, in XML, YAML or Python; empty: only `programs`.
  std::filesystem::path file = {};
  std::vector<std::pair<std::string, std::string>> arguments = {};  // of the launch file: name, value
  std::vector<Program> programs = {};                               // started beside it, without any order

  // What is recorded: names and patterns, as `events-ust` of <trace> has them. Empty: nothing, and the run has a trace
  // only if the launch file has a <trace>. Then all events of this trace are given.
  std::vector<std::string> events = {"ros2:*", "ros2_ext:*"};
  // Also the events of processes that the processes of the launch have started. Events of other programs of the
  // user, which run at the same time, cannot be told from them.
  bool all_processes = false;

  std::map<std::string, std::string> environment = {};  // on top of that of the test
  std::filesystem::path launch_program = {};  // empty: $LAUNCH_PROGRAM, else `launch` beside this library, else in PATH
  std::chrono::milliseconds patience{60'000};  // how long each wait lasts before the run is ended
};

struct RunResult {
  int exit_code = -1;      // of the launcher; -1 when it did not exit by itself
  int signal = 0;          // that ended the launcher, or 0
  bool timed_out = false;  // it was ended after RunOptions::patience
  // Each process that the end of the launch has left running, as the launcher says it: "planner-3 left 1 process
  // running: sleep (1234)". They are ended.
  std::vector<std::string> left;
  std::string out;  // what the launcher and the processes wrote
  std::string err;
};

// To be used from one thread. Throws std::runtime_error when the run can't be started.
class LaunchRun {
 public:
  explicit LaunchRun(RunOptions options);
  // Ends the run if it is still going on, and removes its directory unless keep() was called.
  ~LaunchRun();
  LaunchRun(const LaunchRun&) = delete;
  LaunchRun& operator=(const LaunchRun&) = delete;

  // Until the system has ended by itself. A run that is out of patience is ended as by Ctrl-C, after 30 s more by
  // SIGKILL.
  RunResult wait();
  // Ends the system as Ctrl-C does.
  RunResult stop();
  // Until the launcher or a process has written `text`. False when the run has ended without it, or patience is over.
  bool wait_for_output(const std::string& text);
  std::string out() const;  // so far
  std::string err() const;

  // After wait() or stop(). Throws TraceError when there is no trace; the message says what the launcher said.
  Trace trace() const;

  const std::filesystem::path& directory() const;        // of the run
  const std::filesystem::path& trace_directory() const;  // the directory below it that holds the traces
  int domain_id() const;
  void keep();  // the directory stays

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace launch_trace_testing
