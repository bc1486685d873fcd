// SPDX-License-Identifier: Apache-2.0
// Runs programs for end-to-end tests and waits for what they print.
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
  int signal = 0;      // that ended it, or 0
  bool timed_out = false;
  bool output_closed = false;  // false: some process it left behind still holds its stdout or stderr
  std::string out;
  std::string err;
};

#ifdef __SANITIZE_THREAD__
inline constexpr std::chrono::seconds kCommandTimeout{120};  // programs take ten times as long
#else
inline constexpr std::chrono::seconds kCommandTimeout{30};
#endif

// A started program, in a process group of its own. It is killed, group and all, if it still runs at the end of scope.
// Use it from one thread.
class RunningCommand {
 public:
  explicit RunningCommand(const Command& command);
  ~RunningCommand();
  RunningCommand(const RunningCommand&) = delete;
  RunningCommand& operator=(const RunningCommand&) = delete;

  pid_t pid() const { return pid_; }

  // Reads until stdout or stderr contains `text`. False when the time is over or the program ended without it.
  bool wait_for_output(const std::string& text, std::chrono::milliseconds timeout = kCommandTimeout);

  // To its stdin, which is a pipe.
  void write(const std::string& text);
  void close_input();

  // To the program alone, not to its group.
  void send_signal(int number);

  // Until the program ends; kills it (timed_out) when the time is over. May be called again: gives the same.
  CommandResult wait(std::chrono::milliseconds timeout = kCommandTimeout);

  // What was read so far, for messages.
  const std::string& out() const { return result_.out; }
  const std::string& err() const { return result_.err; }

 private:
  // Reads what there is, waiting for at most `timeout`. False when nothing more can come.
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

// The whole file. Throws std::runtime_error naming it when it can't be read.
std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace test_support
