// SPDX-License-Identifier: Apache-2.0
// How a launch ends.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "launcher/run/launch_service.hpp"

namespace launch {

// The end: a farewell, then the processes, then the scopes.

void LaunchService::fail(const LaunchError& error) {
  outcome_.on_error();
  errors_(error);
  shutdown("an error");
}

void LaunchService::shutdown(const std::string& reason) {
  if (phase_ == Phase::kRunning) {
    phase_ = Phase::kFarewell;
    test_.on_shutdown();
    health_.monitor.shutdown();
    steering_.tell_end(reason);
    tell_end();
    rounds_.close();
    timers_.shutdown();
    processes_.shutdown();
    std::vector<Invocation> farewell = handlers_.shutdown(reason);
    coroutines_.cancel();
    reloads_.shutdown();
    ros_tasks_.shutdown();
    farewell_.say(std::move(farewell));
  }
  check_finished();
}

void LaunchService::tell_end() {
  if (on_end_) {
    std::exchange(on_end_, nullptr)();
  }
}

Requests LaunchService::visit_farewell(const Invocation& invocation) {
  try {
    context_.visit(invocation);
    context_.machines().check_files();
    Requests requests = context_.take_requests();
    check_farewell(requests, invocation.handler->live);
    processes_.check(requests.commands);
    return requests;
  } catch (const LaunchError& error) {
    context_.machines().forget_files();
    context_.take_requests();
    fail(error);
    return {};
  }
}

void LaunchService::stop_processes() {
  phase_ = Phase::kStopping;
  supervisor_.shutdown();
  check_finished();
}

bool LaunchService::is_idle() const {
  return !(phase_ == Phase::kRunning && steering_.holds()) && rounds_.empty() && timers_.empty() && handlers_.idle() &&
         !processes_.waiting() && supervisor_.active() == 0 && coroutines_.idle() && ros_tasks_.idle() &&
         reloads_.idle();
}

void LaunchService::check_started() {
  if (on_started_ && phase_ == Phase::kRunning && rounds_.empty() && !processes_.waiting()) {
    std::exchange(on_started_, nullptr)();
  }
}

void LaunchService::check_finished() {
  check_started();
  reloads_.proceed();
  if (!is_idle()) {
    return;
  }
  if (phase_ == Phase::kRunning && handlers_.has_on_shutdown()) {
    shutdown("idle");
  } else if (phase_ == Phase::kRunning || phase_ == Phase::kStopping) {
    end_scopes();
  }
}

void LaunchService::post_check() {
  if (!check_posted_) {
    check_posted_ = true;
    loop_.post([this] {
      check_posted_ = false;
      check_finished();
    });
  }
}

void LaunchService::end_scopes() {
  if (phase_ == Phase::kRunning) {
    steering_.tell_end("idle");
    tell_end();
  }
  phase_ = Phase::kEndingScopes;
  handlers_.shutdown("idle");
  ros_tasks_.shutdown();
  test_.on_end();
  recording_.end();
  scopes_.end(
      [this](const LaunchError& error) {
        outcome_.on_error();
        errors_(error);
      },
      [this, last_exit = loop_.now()] {
        crashes_.finish([this, last_exit] {
          phase_ = Phase::kDone;
          timing_.push_back({"end, from the last exit", loop_.now() - last_exit});
          loop_.quit();
        });
      });
}

}  // namespace launch
