// SPDX-License-Identifier: Apache-2.0
// Runs programs for end-to-end tests and waits for their output.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace test_support {

// argv[0] is looked up in PATH. The environment is the test's own with `environment` on top.
struct Command {
  std::vector<std::string> argv;
  std::map<std::string, std::string> environment = {};
  std::filesystem::path directory = {};  // empty: the test's own
};

struct CommandResult {
  int exit_code = -1;  // -1 when it did not exit by itself
  int signal = 0;      // the signal that ended it, or 0
  bool timed_out = false;
  bool output_closed = false;  // false: a process that it left behind still holds its stdout or stderr
  std::string out;
  std::string err;
};

// What takes so long hangs, on a busy machine and under a sanitizer, too.
inline constexpr std::chrono::seconds kCommandTimeout{120};

// A started program, in a process group of its own. If it still runs at the end of the scope, it is killed together
// with its group. Use it from one thread.
class RunningCommand {
 public:
  explicit RunningCommand(const Command& command);
  // Kills the program and its group if the program still runs.
  ~RunningCommand();
  RunningCommand(const RunningCommand&) = delete;
  RunningCommand& operator=(const RunningCommand&) = delete;

  pid_t pid() const { return pid_; }

  // Reads until stdout or stderr contains `text`. False when the time is over, or when the program ended without it.
  bool wait_for_output(const std::string& text, std::chrono::milliseconds timeout = kCommandTimeout);

  // Writes to its stdin, which is a pipe.
  void write(const std::string& text);
  void close_input();

  // Sends a signal to the program alone, not to its group.
  void send_signal(int number);

  // Waits until the program ends. Kills it (timed_out) when the time is over. A further call returns the same result.
  CommandResult wait(std::chrono::milliseconds timeout = kCommandTimeout);

  // Sends SIGINT and waits. A test with a participant of its own ends the nodes that it started this way, because the
  // destructor kills them: a killed process may keep a lock in the shared memory of Fast DDS 2.9, and a participant
  // that is destroyed meanwhile may crash.
  CommandResult end_gently();

  // The output that was read so far, for messages.
  const std::string& out() const { return result_.out; }
  const std::string& err() const { return result_.err; }

 private:
  // Reads what is there, and waits at most `timeout` for it. False when nothing more can come.
  bool read_some(std::chrono::milliseconds timeout);
  void drain();
  void reap();

  pid_t pid_ = -1;
  int pidfd_ = -1;
  int in_ = -1;
  int out_ = -1;
  int err_ = -1;
  bool ended_ = false;  // reaped, result_ is complete
  CommandResult result_;
};

// Runs a program to its end, with `input` as its stdin.
CommandResult run_command(const Command& command, std::chrono::milliseconds timeout = kCommandTimeout,
                          const std::string& input = {});
CommandResult run_command(const std::vector<std::string>& argv);

// Returns the whole file. Throws std::runtime_error with its name when it can't be read.
std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace test_support
