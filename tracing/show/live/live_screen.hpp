// SPDX-License-Identifier: Apache-2.0
// Where a live report appears: drawn anew on a terminal, a line each time anywhere else. Waits for what ends it.
#pragma once

#include <signal.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {

struct LiveOptions {
  std::chrono::nanoseconds interval = std::chrono::seconds(1);  // between two drawings
  ReportOptions text{};
  bool json = false;         // the report at the end is JSON; lines before it go to standard error
  bool is_terminal = false;  // standard output
  std::function<std::vector<ChainDefinition>()> chains = {};  // the chains with names, of directories
};

// Blocks SIGINT and SIGTERM, which end a live report, until it is destroyed.
class LiveScreen {
 public:
  explicit LiveScreen(const LiveOptions& options);
  ~LiveScreen();
  LiveScreen(const LiveScreen&) = delete;
  LiveScreen& operator=(const LiveScreen&) = delete;

  bool draws() const { return options_.is_terminal && !options_.json; }
  // `screen` on a terminal, else `line`; with the time. Throws when it can't be written.
  void show(const std::string& title, const std::string& screen, const std::string& line);
  // What is told once, such as that a session is not there yet.
  void note(const std::string& text);
  // The report at the end.
  void finish(const Report& report);

  // Returns whether the user has ended the report. Waits that long at most.
  bool is_over_after(std::chrono::nanoseconds time);

 private:
  void print(const std::string& text, bool to_errors) const;

  LiveOptions options_;
  sigset_t previous_mask_{};
  bool is_over_ = false;
};

}  // namespace tracing
