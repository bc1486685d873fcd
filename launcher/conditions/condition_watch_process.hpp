// SPDX-License-Identifier: Apache-2.0
// The launcher's end of launch-watch --conditions. It starts the program with the first condition, and exchanges
// messages with it over a socket (condition_lines.hpp).
//
// The program has a session of its own, so that Ctrl-C does not reach it. It ends when its socket closes, and so also
// when the launcher is killed.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"
#include "launcher/conditions/condition_watch.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

class ConditionWatchProcess final : public ConditionWatch {
 public:
  // The loop must outlive it. `launch`: the number in the marks of the launch's processes. `program` is for tests.
  ConditionWatchProcess(EventLoop& loop, std::string launch, std::string program = {});
  ~ConditionWatchProcess() override;  // waits for the program to end its recording, some seconds at most
  ConditionWatchProcess(const ConditionWatchProcess&) = delete;
  ConditionWatchProcess& operator=(const ConditionWatchProcess&) = delete;

  void observe(Tell tell) override { tell_ = std::move(tell); }
  // A program that ends although it has recorded is started again some times, with all conditions.
  void watch(tracing::ConditionId id, const tracing::LiveCondition& condition) override;
  void forget(tracing::ConditionId id) override;
  void close() override;

 private:
  void start();
  void write(const std::string& line);
  void flush();
  void on_readable();
  void on_line(std::string_view line);
  void lose();
  void fail(const std::string& error, const std::string& help);
  int reap();

  EventLoop& loop_;
  std::string launch_;
  std::string program_;
  Tell tell_;
  std::map<tracing::ConditionId, tracing::LiveCondition> watched_;
  UniqueFd socket_;
  pid_t pid_ = -1;
  bool has_recorded_ = false;
  bool has_failed_ = false;  // the program has said why
  int restarts_ = 0;
  EventLoop::SourcePtr readable_;
  EventLoop::SourcePtr retry_;
  EventLoop::SourcePtr again_;
  std::string unwritten_;
  std::string unread_;  // the beginning of a line
};

}  // namespace launch
