// SPDX-License-Identifier: Apache-2.0
#include "launcher/conditions/condition_watch_process.hpp"

#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <variant>

#include "base/environment/own_prefix.hpp"

namespace launch {
namespace {

constexpr const char* kWatchProgram = "launch-watch";
// A recording ends within tenths of a second, unless the session daemon does not answer.
constexpr std::chrono::milliseconds kLongestEndOfRecording{15'000};
constexpr int kMostRestarts = 5;
constexpr int kMostRestartsOfOneThatSaysNothing = 2;  // and has never recorded
constexpr std::chrono::seconds kBeforeRestart{1};     // and twice as long each time

}  // namespace

ConditionWatchProcess::ConditionWatchProcess(EventLoop& loop, std::string launch, std::string program)
    : loop_(loop), launch_(std::move(launch)), program_(std::move(program)) {}

void ConditionWatchProcess::watch(tracing::ConditionId id, const tracing::LiveCondition& condition) {
  watched_.insert_or_assign(id, condition);
  if (again_) {
    return;  // it is among those of the next start
  }
  if (const std::string need = needs_of(condition); running_ && (need.empty() || recorded_.contains(need))) {
    return write(tracing::WatchCondition{id, condition});
  }
  if (running_) {
    running_->close();
    ending_.push_back(std::move(running_));
  }
  again_ = loop_.after(Duration(0), [this] { start(); });
}

void ConditionWatchProcess::forget(tracing::ConditionId id) {
  if (watched_.erase(id) != 0 && running_) {
    write(tracing::ForgetCondition{id});
  }
}

void ConditionWatchProcess::close() {
  again_.reset();
  watched_.clear();
  if (running_) {
    running_->close();
  }
}

void ConditionWatchProcess::start() {
  again_.reset();
  has_failed_ = false;
  running_ = std::make_shared<LineProgram>(loop_, kLongestEndOfRecording);
  recorded_.clear();
  for (const auto& [id, condition] : watched_) {
    if (std::string need = needs_of(condition); !need.empty()) {
      recorded_.insert(std::move(need));
    }
  }
  std::vector<std::string> argv = {kWatchProgram, "--conditions", launch_};
  argv.insert(argv.end(), recorded_.begin(), recorded_.end());
  try {
    running_->start({.program = program_.empty() ? own_library_file(kWatchProgram) : program_,
                     .argv = std::move(argv),
                     .descriptors = {{STDIN_FILENO, LineProgram::kSocket},
                                     {STDOUT_FILENO, LineProgram::kSocket},
                                     {STDERR_FILENO, kDevNull}}},
                    {.line = [this](std::string_view line) { on_line(line); },
                     .end =
                         [this](const std::string& how) {
                           running_.reset();
                           if (!has_failed_) {
                             fail(std::string(kWatchProgram) + " " + how, "", kMostRestartsOfOneThatSaysNothing);
                           }
                         }});
  } catch (const std::system_error& error) {
    running_.reset();
    return fail(error.what(), "");
  }
  for (const auto& [id, condition] : watched_) {
    write(tracing::WatchCondition{id, condition});
  }
}

void ConditionWatchProcess::on_line(std::string_view line) {
  tracing::ConditionReport report;
  try {
    report = tracing::parse_condition_report(line);
  } catch (const std::runtime_error&) {
    return;  // of another version
  }
  if (const auto* const failed = std::get_if<tracing::WatchFailed>(&report)) {
    has_failed_ = true;
    return fail(failed->error, failed->help);
  }
  has_recorded_ |= std::holds_alternative<tracing::NodesAreRecorded>(report);
  tell_(report);
}

// A program that has recorded is started again: what has ended it may be over. So is one that ends without a word:
// libbabeltrace2 2.1 is ended by SIGSEGV if it attaches when LTTng has described the session, but none of its streams.
void ConditionWatchProcess::fail(const std::string& error, const std::string& help, int most_restarts) {
  const bool goes_on = restarts_ < (has_recorded_ ? kMostRestarts : most_restarts);
  if (goes_on) {
    again_ = loop_.after(kBeforeRestart * (1 << restarts_++), [this] { start(); });
  }
  loop_.post([this, error, help, goes_on] { tell_(tracing::WatchFailed{error, help, goes_on}); });
}

}  // namespace launch
