// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/scopes/active_scopes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "launcher/process/guardian/guardian.hpp"

namespace launch {

namespace {

LaunchError error_of(const RunScope& scope, const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const LaunchError& failure) {
    return failure;
  } catch (const std::exception& failure) {
    return LaunchError(failure.what(), scope.origin());
  }
}

}  // namespace

ActiveScopes::ActiveScopes(EventLoop& loop, RunScope::Tell tell, std::vector<TimedStep>& timing)
    : loop_(loop), tell_(std::move(tell)), timing_(timing) {}

void ActiveScopes::begin(std::unique_ptr<RunScope> scope, const std::vector<ProcessSpec>& processes, Begun done) {
  beginning_ = std::move(scope);
  beginning_->observe_snapshots(snapshot_observer_);
  guard(*beginning_);
  beginning_->expect(processes);
  beginning_->begin(loop_, tell_,
                    [this, done = std::move(done)](const std::exception_ptr& error) { on_begun(error, done); });
}

void ActiveScopes::on_begun(const std::exception_ptr& error, const Begun& done) {
  // The scope that calls this function lives until it returns.
  const Begun done_now = done;
  if (error) {
    const std::unique_ptr<RunScope> scope = std::move(beginning_);
    release(*scope);
    done_now(error_of(*scope, error));
    return;
  }
  keep_timing(*beginning_);
  active_.push_back(std::move(beginning_));
  done_now(std::nullopt);
}

void ActiveScopes::end(std::function<void(const LaunchError&)> failed, std::function<void()> done) {
  failed_ = std::move(failed);
  done_ = std::move(done);
  end_last();
}

void ActiveScopes::end_last() {
  if (active_.empty()) {
    done_();
    return;
  }
  if (hurried_) {
    active_.back()->hurry();
  }
  active_.back()->end(loop_, tell_, [this](const std::exception_ptr& error) { on_ended(error); });
}

void ActiveScopes::on_ended(const std::exception_ptr& error) {
  const RunScope& scope = *active_.back();
  if (error) {
    failed_(error_of(scope, error));
  }
  keep_timing(scope);
  release(scope);
  active_.pop_back();
  end_last();
}

std::string ActiveScopes::busy_with() const {
  const RunScope* const scope = beginning_                  ? beginning_.get()
                                : done_ && !active_.empty() ? active_.back().get()
                                                            : nullptr;
  return scope == nullptr ? "" : fmt::format("{} ({})", scope->kind(), to_string(scope->origin()));
}

void ActiveScopes::hurry() {
  hurried_ = true;
  for (const auto& scope : active_) {
    scope->hurry();
  }
}

void ActiveScopes::prepare(ProcessSpec& spec) const {
  for (const auto& scope : active_) {
    scope->prepare(spec);
  }
}

void ActiveScopes::record(const LaunchRecord& record) {
  for (const auto& scope : active_) {
    scope->record(record);
  }
}

bool ActiveScopes::want_records() const {
  return std::any_of(active_.begin(), active_.end(), [](const auto& scope) { return scope->wants_records(); });
}

void ActiveScopes::keep_timing(const RunScope& scope) {
  for (TimedStep& step : scope.timing()) {
    timing_.push_back(std::move(step));
  }
}

// The guard begins before begin(): a launcher that is killed never leaves the scope's work behind.
void ActiveScopes::guard(RunScope& scope) {
  const std::vector<std::string> command = scope.clean_up_command();
  if (guardian_ != nullptr && !command.empty()) {
    clean_ups_.emplace(&scope, guardian_->add_clean_up(command));
  }
}

void ActiveScopes::release(const RunScope& scope) {
  if (const auto found = clean_ups_.find(&scope); found != clean_ups_.end()) {
    guardian_->remove_clean_up(found->second);
    clean_ups_.erase(found);
  }
}

}  // namespace launch
