#include "launcher/core/launch_service.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>

#include <algorithm>

namespace launch {

LaunchService::LaunchService(LaunchContext& context, EventLoop& loop, ProcessSupervisor& supervisor, ErrorSink errors)
    : context_(context), loop_(loop), supervisor_(supervisor), errors_(std::move(errors)) {
  supervisor_.observe([this](const ProcessEvent& event) { on_process_event(event); });
}

void LaunchService::use_ros_client(RosClient& client) {
  context_.use_ros_client(client);
  ros_tasks_ = std::make_unique<RosTasks>(
      context_, loop_, client, [this] { post_check(); }, [this](const LaunchError& error) { fail(error); });
}

int LaunchService::run(const LaunchDescription& description) {
  const EventLoop::SourcePtr signals =
      loop_.on_signal({SIGINT, SIGTERM, SIGHUP, SIGQUIT}, [this](int signal) { on_signal(signal); });
  loop_.post([this, &description] {
    const Duration before = loop_.now();
    try {
      context_.visit(description);
    } catch (const LaunchError& error) {
      context_.take_requests();
      fail(error);
      return;
    }
    timing_.push_back({"visit", loop_.now() - before});
    carry_out(context_.take_requests());
  });
  loop_.run();
  return exit_code_;
}

void LaunchService::on_signal(int signal) {
  const std::string name = signal == SIGINT ? "ctrl-c (SIGINT)" : fmt::format("SIG{}", sigabbrev_np(signal));
  if (++signals_ == 1) {
    context_.message(LogLevel::kWarning, "launch", fmt::format("user interrupted with {}", name));
    shutdown();
    return;
  }
  context_.message(LogLevel::kWarning, "launch",
                   fmt::format("user interrupted with {} again, killing what is left", name));
  supervisor_.kill_all();
  for (const auto& scope : active_scopes_) {
    scope->hurry();
  }
}

void LaunchService::on_process_event(const ProcessEvent& event) {
  const bool failed_to_start = std::holds_alternative<ProcessStartFailed>(event.what);
  if (failed_to_start) {
    exit_code_ = 1;
  }
  if (event.spec.shutdown_on_exit && (failed_to_start || std::holds_alternative<ProcessExited>(event.what)) &&
      !shutting_down_) {
    context_.message(LogLevel::kInfo, "launch",
                     fmt::format("process[{}] was required: shutting down launched system", event.label));
    shutdown();
  }
  if (ros_tasks_) {
    ros_tasks_->on_process_event(event);
  }
  if (std::holds_alternative<ProcessDone>(event.what)) {
    post_check();
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

void LaunchService::on_timer(std::list<Timer>::iterator timer) {
  TimerRequest request = std::move(timer->request);
  timers_.erase(timer);
  try {
    context_.visit_in(std::move(request.scope), request.actions);
  } catch (const LaunchError& error) {
    context_.take_requests();
    fail(error);
    return;
  }
  carry_out(context_.take_requests());
}

void LaunchService::carry_out(Requests requests) {
  if (shutting_down_) {
    check_finished();
    return;
  }
  waiting_.push_back(std::move(requests));
  if (waiting_.size() == 1) {
    begin_next();
  }
}

void LaunchService::begin_next() {
  while (!waiting_.empty()) {
    if (next_scope_ < waiting_.front().scopes.size()) {
      scope_is_beginning_ = true;
      guard(*waiting_.front().scopes[next_scope_]);
      waiting_.front().scopes[next_scope_]->begin(loop_, teller(),
                                                  [this](std::exception_ptr error) { on_begun(std::move(error)); });
      return;
    }
    next_scope_ = 0;
    Requests requests = std::move(waiting_.front());
    waiting_.pop_front();
    start(std::move(requests));
  }
  check_finished();
}

void LaunchService::on_begun(std::exception_ptr error) {
  scope_is_beginning_ = false;
  std::unique_ptr<RunScope> scope = std::move(waiting_.front().scopes[next_scope_++]);
  if (error) {
    unguard(*scope);
    try {
      std::rethrow_exception(error);
    } catch (const LaunchError& failure) {
      fail(failure);
    } catch (const std::exception& failure) {
      fail(LaunchError(failure.what(), scope->origin()));
    }
    return;
  }
  for (TimedStep& step : scope->timing()) {
    timing_.push_back(std::move(step));
  }
  active_scopes_.push_back(std::move(scope));
  if (shutting_down_) {
    waiting_.clear();
    next_scope_ = 0;
    check_finished();
    return;
  }
  begin_next();
}

void LaunchService::start(Requests requests) {
  const Duration before = loop_.now();
  for (TimerRequest& request : requests.timers) {
    timers_.push_back({std::move(request), nullptr});
    const auto timer = std::prev(timers_.end());
    timer->source = loop_.after(timer->request.period, [this, timer] { on_timer(timer); });
  }
  auto node = requests.nodes.begin();
  for (std::size_t i = 0; i < requests.processes.size(); ++i) {
    ProcessSpec& spec = requests.processes[i];
    for (const auto& scope : active_scopes_) {
      scope->prepare(spec);
    }
    const ProcessId id = supervisor_.start(std::move(spec));
    if (node != requests.nodes.end() && node->process == i) {
      if (ros_tasks_ && node->name) {
        const std::string name_space = node->name_space.value_or("/");
        ros_tasks_->name_process(id, (name_space == "/" ? "" : name_space) + "/" + *node->name);
      }
      ++node;
    }
  }
  timing_.push_back({fmt::format("start {} processes", requests.processes.size()), loop_.now() - before});
  start_ros_tasks(requests);
  if (requests.shutdown) {
    shutdown();
  }
}

void LaunchService::start_ros_tasks(Requests& requests) {
  if (!ros_tasks_ && !(requests.loads.empty() && requests.transitions.empty())) {
    fail(LaunchError("there is no ROS client to load components and change states",
                     requests.loads.empty() ? requests.transitions.front().origin : requests.loads.front().origin));
    return;
  }
  for (LoadRequest& request : requests.loads) {
    ros_tasks_->load(std::move(request));
  }
  for (TransitionRequest& request : requests.transitions) {
    ros_tasks_->change_state(std::move(request));
  }
}

void LaunchService::fail(const LaunchError& error) {
  exit_code_ = 1;
  errors_(error);
  shutdown();
}

void LaunchService::shutdown() {
  if (!shutting_down_) {
    shutting_down_ = true;
    if (!scope_is_beginning_) {
      waiting_.clear();
      next_scope_ = 0;
    }
    timers_.remove_if([](const Timer& timer) { return timer.request.cancel_on_shutdown; });
    supervisor_.shutdown();
    if (ros_tasks_) {
      ros_tasks_->shutdown();
    }
  }
  check_finished();
}

void LaunchService::check_finished() {
  if (ending_ || scope_is_beginning_ || !waiting_.empty() || !timers_.empty() || supervisor_.active() != 0 ||
      (ros_tasks_ && !ros_tasks_->idle())) {
    return;
  }
  ending_ = true;
  shutting_down_ = true;
  if (ros_tasks_) {
    ros_tasks_->shutdown();
  }
  end_next_scope();
}

void LaunchService::end_next_scope() {
  if (active_scopes_.empty()) {
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
    unguard(*active_scopes_.back());
    active_scopes_.pop_back();
    end_next_scope();
  });
}

// From before begin(), so that there is no moment at which a killed launcher leaves the scope's work behind.
void LaunchService::guard(const RunScope& scope) {
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

RunScope::Tell LaunchService::teller() {
  return [this](bool warning, const std::string& text) {
    context_.message(warning ? LogLevel::kWarning : LogLevel::kInfo, "launch.trace", text);
  };
}

}  // namespace launch
