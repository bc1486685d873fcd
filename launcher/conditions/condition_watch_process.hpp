// SPDX-License-Identifier: Apache-2.0
// The launcher's end of launch-watch --conditions. It starts the program (line_program.hpp) when a turn of the loop has
// brought the first conditions, and exchanges messages with it (condition_lines.hpp). A condition that needs more than
// is recorded starts another one in its place.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/conditions/condition_watch.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/line_program.hpp"

namespace launch {

class ConditionWatchProcess final : public ConditionWatch {
 public:
  // The loop must outlive it. `launch`: the number in the marks of the launch's processes. `program` is for tests.
  ConditionWatchProcess(EventLoop& loop, std::string launch, std::string program = {});
  // The destructor waits for the program to end its recording, some seconds at most.
  ConditionWatchProcess(const ConditionWatchProcess&) = delete;
  ConditionWatchProcess& operator=(const ConditionWatchProcess&) = delete;

  void observe(Tell tell) override { tell_ = std::move(tell); }
  // A program that ends although it has recorded, or without saying why, is started again some times, with all
  // conditions.
  void watch(tracing::ConditionId id, const tracing::LiveCondition& condition) override;
  void forget(tracing::ConditionId id) override;
  void close() override;

 private:
  void start();
  void write(const tracing::ConditionOrder& order) { running_->write(to_line(order)); }
  void on_line(std::string_view line);
  // `most_restarts`: of a program that has never recorded.
  void fail(const std::string& error, const std::string& help, int most_restarts = 0);

  EventLoop& loop_;
  std::string launch_;
  std::string program_;
  Tell tell_;
  std::map<tracing::ConditionId, tracing::LiveCondition> watched_;
  std::shared_ptr<LineProgram> running_;  // null: it has ended, or was never started
  std::set<std::string> recorded_;        // what it was started to record (needs_of)
  std::vector<std::shared_ptr<LineProgram>> ending_;
  bool has_recorded_ = false;
  bool has_failed_ = false;  // the program has said why
  int restarts_ = 0;
  EventLoop::SourcePtr again_;
};

}  // namespace launch
