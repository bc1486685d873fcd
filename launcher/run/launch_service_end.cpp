// SPDX-License-Identifier: Apache-2.0
// The end of a launch: what on_shutdown handlers ask for, the processes, the scopes.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "launcher/run/launch_service.hpp"
#include "launcher/visit/farewell.hpp"

namespace launch {

void LaunchService::fail(const LaunchError& error) {
  exit_code_ = 1;
  errors_(error);
  shutdown("an error");
}

void LaunchService::shutdown(const std::string& reason) {
  if (!shutting_down_) {
    shutting_down_ = true;
    if (!scope_is_beginning_) {
      waiting_.clear();
      next_scope_ = 0;
    }
    timers_.remove_if([](const Timer& timer) { return timer.request.cancel_on_shutdown; });
    start_order_.clear();
    waits_.clear();
    state_handlers_.clear();
    coroutines_.cancel();
    if (ros_tasks_) {
      ros_tasks_->shutdown();
    }
    last_invocations_ = handlers_.on_shutdown(reason);
    if (last_invocations_.empty()) {
      supervisor_.shutdown();
    } else {
      farewell_ = true;
      loop_.post([this] { say_farewell(); });
    }
  }
  check_finished();
}

// Visits the handlers of on_shutdown. Everything is still up, but nothing else starts any more.
void LaunchService::say_farewell() {
  if (!farewell_) {
    return;  // a second signal came first
  }
  Duration timeout{0};
  for (const Invocation& invocation : std::exchange(last_invocations_, {})) {
    timeout = std::max(timeout, std::get<OnShutdown>(invocation.handler->event).timeout);
    visit_farewell(invocation);
  }
  if (last_processes_.empty()) {
    end_farewell();
    return;
  }
  farewell_timer_ = loop_.after(timeout, [this, timeout] {
    context_.message(LogLevel::kWarning, "launch",
                     fmt::format("on_shutdown: {} s have passed, the system ends now",
                                 std::chrono::duration<double>(timeout).count()));
    end_farewell();
  });
}

void LaunchService::visit_farewell(const Invocation& invocation) {
  Requests requests;
  try {
    context_.visit_in(invocation.scope(), invocation.handler->actions);
    requests = context_.take_requests();
    check_farewell(requests);
    check_commands(requests.commands, table_);
  } catch (const LaunchError& error) {
    context_.take_requests();
    fail(error);
    return;
  }
  for (const ProcessCommand& command : requests.commands) {
    execute(command);
  }
  for (ProcessSpec& spec : requests.processes) {
    spec.respawn.enabled = false;
    spec.shutdown_on_exit = spec.required = false;
    TrackedProcess& process = table_.add(spec);
    last_processes_.insert(supervisor_.next_id());
    start_process(std::move(spec), process);
  }
}

void LaunchService::end_farewell() {
  if (farewell_) {
    farewell_ = false;
    farewell_timer_.reset();
    supervisor_.shutdown();
    check_finished();
  }
}

// Later, for whoever tells of an end may still be at work.
void LaunchService::post_check() {
  if (!check_posted_) {
    check_posted_ = true;
    loop_.post([this] {
      check_posted_ = false;
      check_finished();
    });
  }
}

void LaunchService::check_finished() {
  if (ending_ || scope_is_beginning_ || farewell_ || !waiting_.empty() || !timers_.empty() || !events_.empty() ||
      !start_order_.empty() || supervisor_.active() != 0 || !coroutines_.idle() ||
      (ros_tasks_ && !ros_tasks_->idle())) {
    return;
  }
  if (!shutting_down_ && handlers_.has_on_shutdown()) {
    shutdown("idle");
    return;
  }
  ending_ = true;
  shutting_down_ = true;
  last_exit_ = loop_.now();
  if (ros_tasks_) {
    ros_tasks_->shutdown();
  }
  end_next_scope();
}

void LaunchService::end_next_scope() {
  if (std::exchange(recording_, false)) {
    recorder_->end();
  }
  if (active_scopes_.empty()) {
    timing_.push_back({"end, from the last exit", loop_.now() - last_exit_});
    loop_.quit();
    return;
  }
  if (signals_ > 1) {
    active_scopes_.back()->hurry();
  }
  active_scopes_.back()->end(loop_, teller(), [this](std::exception_ptr error) {
    if (error) {
      try {
        std::rethrow_exception(error);
      } catch (const std::exception& failure) {
        exit_code_ = 1;
        errors_(LaunchError(failure.what(), active_scopes_.back()->origin()));
      }
    }
    append_timing(*active_scopes_.back());
    unguard(*active_scopes_.back());
    active_scopes_.pop_back();
    end_next_scope();
  });
}

void LaunchService::append_timing(const RunScope& scope) {
  for (TimedStep& step : scope.timing()) {
    timing_.push_back(std::move(step));
  }
}

// From before begin(), so that there is no moment at which a killed launcher leaves the scope's work behind.
void LaunchService::guard(RunScope& scope) {
  const std::vector<std::string> command = scope.clean_up_command();
  if (guardian_ != nullptr && !command.empty()) {
    clean_ups_.emplace(&scope, guardian_->add_clean_up(command));
  }
}

void LaunchService::unguard(const RunScope& scope) {
  if (const auto found = clean_ups_.find(&scope); found != clean_ups_.end()) {
    guardian_->remove_clean_up(found->second);
    clean_ups_.erase(found);
  }
}

}  // namespace launch
