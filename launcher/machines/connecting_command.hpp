// SPDX-License-Identifier: Apache-2.0
// The command of a `connect`, such as `ssh arm`, with the agent's command behind it: a child of the launcher whose
// standard input and output reach the agent.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/unique_fd.hpp"

namespace launch {

class ConnectingCommand {
 public:
  // Starts it in a session of its own: a Ctrl-C on the terminal must not cut the connection by which processes are
  // ended, and a question for a password can't take the terminal. Throws SpawnError.
  explicit ConnectingCommand(const std::vector<std::string>& words);
  // Ends it.
  ~ConnectingCommand();
  ConnectingCommand(const ConnectingCommand&) = delete;
  ConnectingCommand& operator=(const ConnectingCommand&) = delete;

  // Its standard input, once.
  UniqueFd take_input() { return std::move(input_); }
  int output() const { return output_.get(); }
  int error() const { return error_.get(); }

  // Reads what it has written to standard error, without waiting. Lines go to `tell`, if it is given. False at the end.
  bool read_error(const std::function<void(std::string_view line)>& tell);
  // The last lines of it.
  const std::deque<std::string>& last_lines() const { return lines_; }

  // Lets it end by itself for so long, then sends SIGTERM and SIGKILL. Returns "ended with exit code 255", or
  // "was ended by SIGTERM". Later calls return the same.
  std::string end(std::chrono::milliseconds patience);
  // The exit code; -1 if it was ended by a signal, or has not ended.
  int exit_code() const { return exit_code_; }
  bool has_ended() const { return pid_ < 0; }
  // For so long, false if it still runs then.
  bool ends_by_itself(std::chrono::milliseconds patience) const;

 private:
  pid_t pid_ = -1;
  UniqueFd input_;
  UniqueFd output_;
  UniqueFd error_;
  std::string rest_;  // of a line that has not ended
  std::deque<std::string> lines_;
  std::string how_ = "has not been started";
  int exit_code_ = -1;
};

}  // namespace launch
