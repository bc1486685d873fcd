// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/launch_service.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>

#include <algorithm>

#include "launcher/base/monotonic_clock.hpp"
#include "launcher/visit/dependency_resolution.hpp"

namespace launch {

namespace {

constexpr int kExitCodeOfSignal = 128;  // plus its number, as shells count

// To a process that is not done.
void send(const ProcessCommand& command, ProcessId id, ProcessSupervisor& supervisor) {
  switch (command.kind) {
    case ProcessCommand::Kind::kStop:
      supervisor.stop(id);
      break;
    case ProcessCommand::Kind::kRestart:
      supervisor.restart(id);
      break;
    case ProcessCommand::Kind::kSignal:
      supervisor.signal(id, command.signal);
      break;
  }
}

}  // namespace

LaunchService::LaunchService(LaunchContext& context, EventLoop& loop, ProcessSupervisor& supervisor, ErrorSink errors)
    : context_(context),
      loop_(loop),
      supervisor_(supervisor),
      errors_(std::move(errors)),
      state_handlers_([this](std::vector<Invocation> invocations) { invoke(std::move(invocations)); },
                      [this](const LaunchError& error) { fail(error); }),
      coroutines_(
          context, loop, [this] { on_step(); }, [this](const LaunchError& error) { fail(error); }),
      start_order_(loop,
                   {[this](ProcessSpec spec, TrackedProcess& process) { start_process(std::move(spec), process); },
                    [this](const LaunchError& error) { fail(error); },
                    [this](LogLevel level, const std::string& process, const std::string& text) {
                      context_.message(level, process, text);
                    },
                    [this](const TrackedProcess& process) {
                      for (const std::string& name : process.names) {
                        if (ros_tasks_ && name.starts_with('/')) {
                          ros_tasks_->on_skipped(name);
                        }
                      }
                    },
                    [this](const std::string& process, const Dependency& dependency) {
                      record({.kind = LaunchRecord::Kind::kReady,
                              .name = process,
                              .what = describe(dependency),
                              .where = dependency.where,
                              .time = monotonic_time()});
                    }}) {
  supervisor_.observe([this](const ProcessEvent& event) { on_process_event(event); });
}

LaunchService::~LaunchService() {
  if (output_observed_) {
    supervisor_.observe_output(nullptr);
  }
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
    const std::int64_t begin = monotonic_time();
    try {
      context_.visit(description);
    } catch (const LaunchError& error) {
      context_.take_requests();
      fail(error);
      return;
    }
    timing_.push_back({"visit", loop_.now() - before});
    Requests requests = context_.take_requests();
    record_visit(begin, {description.file, 0, 0}, requests);
    carry_out(std::move(requests));
  });
  loop_.run();
  return exit_code_;
}

void LaunchService::on_signal(int signal) {
  const std::string name = signal == SIGINT ? "ctrl-c (SIGINT)" : fmt::format("SIG{}", sigabbrev_np(signal));
  if (++signals_ == 1) {
    context_.message(LogLevel::kWarning, "launch", fmt::format("user interrupted with {}", name));
    shutdown(name);
    return;
  }
  context_.message(LogLevel::kWarning, "launch",
                   fmt::format("user interrupted with {} again, killing what is left", name));
  end_farewell();
  supervisor_.kill_all();
  for (const auto& scope : active_scopes_) {
    scope->hurry();
  }
}

void LaunchService::on_process_event(const ProcessEvent& event) {
  record(event);
  if (TrackedProcess* const process = table_.note(event)) {
    start_order_.on_process_event(*process);
  }
  invoke(handlers_.on_event(event));

  const bool failed_to_start = std::holds_alternative<ProcessStartFailed>(event.what);
  const auto* const exited = std::get_if<ProcessExited>(&event.what);
  if (failed_to_start) {
    exit_code_ = 1;
  }
  // One that is ended to be started again doesn't end the system.
  const bool restarts = exited != nullptr && exited->expected && exited->will_respawn;
  const bool ends_system = event.spec.shutdown_on_exit || event.spec.required;
  if (ends_system && (failed_to_start || exited != nullptr) && !restarts && !shutting_down_) {
    context_.message(LogLevel::kInfo, "launch",
                     fmt::format("process[{}] was required: shutting down launched system", event.label));
    if (event.spec.required && exited != nullptr && !exited->expected && exited->exit.code != 0) {
      exit_code_ = exited->exit.code > 0 ? exited->exit.code : kExitCodeOfSignal - exited->exit.code;
    }
    shutdown(fmt::format("process[{}] was required", event.label));
  }
  if (ros_tasks_) {
    ros_tasks_->on_process_event(event);
  }
  if (std::holds_alternative<ProcessDone>(event.what)) {
    if (last_processes_.erase(event.id) != 0 && last_processes_.empty()) {
      loop_.post([this] { end_farewell(); });
    }
    post_check();
  }
}

void LaunchService::on_line(const ProcessSpec& spec, ProcessId id, const std::string& label, OutputStream stream,
                            std::string_view line) {
  if (TrackedProcess* const process = start_order_.watch_output() ? table_.find(id) : nullptr) {
    start_order_.on_line(*process, stream, line);
  }
  invoke(handlers_.on_line(spec, label, stream, line));
}

void LaunchService::on_timer(std::list<Timer>::iterator timer) {
  TimerRequest request = std::move(timer->request);
  timers_.erase(timer);
  visit(std::move(request.scope), request.actions);
}

void LaunchService::visit(Scope scope, const std::vector<ActionPtr>& actions) {
  const std::int64_t begin = monotonic_time();
  try {
    context_.visit_in(std::move(scope), actions);
  } catch (const LaunchError& error) {
    context_.take_requests();
    fail(error);
    return;
  }
  Requests requests = context_.take_requests();
  record_visit(begin, actions.empty() ? SourceRange() : actions.front()->where(), requests);
  carry_out(std::move(requests));
}

void LaunchService::carry_out(Requests requests) {
  if (shutting_down_) {
    check_finished();
    return;
  }
  Round round{std::move(requests), {}};
  for (const ProcessSpec& spec : round.requests.processes) {
    round.processes.push_back(&table_.add(spec));
  }
  try {
    resolve_dependencies(round.requests.dependencies, round.processes, table_);
    check_commands(round.requests.commands, table_);
  } catch (const LaunchError& error) {
    fail(error);
    return;
  }
  waiting_.push_back(std::move(round));
  if (waiting_.size() == 1) {
    begin_next();
  }
}

void LaunchService::begin_next() {
  while (!waiting_.empty()) {
    const auto& scopes = waiting_.front().requests.scopes;
    if (next_scope_ < scopes.size()) {
      scope_is_beginning_ = true;
      guard(*scopes[next_scope_]);
      scopes[next_scope_]->expect(waiting_.front().requests.processes);
      scopes[next_scope_]->begin(loop_, teller(), [this](std::exception_ptr error) { on_begun(std::move(error)); });
      return;
    }
    next_scope_ = 0;
    Round round = std::move(waiting_.front());
    waiting_.pop_front();
    start(std::move(round));
  }
  check_finished();
}

void LaunchService::on_begun(std::exception_ptr error) {
  scope_is_beginning_ = false;
  std::unique_ptr<RunScope> scope = std::move(waiting_.front().requests.scopes[next_scope_++]);
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
  append_timing(*scope);
  active_scopes_.push_back(std::move(scope));
  if (shutting_down_) {
    waiting_.clear();
    next_scope_ = 0;
    check_finished();
    return;
  }
  begin_next();
}

void LaunchService::start(Round round) {
  const Duration before = loop_.now();
  begin_recording();
  Requests& requests = round.requests;
  for (const ProcessCommand& command : requests.commands) {
    execute(command);
  }
  for (const UnregisterRequest& request : requests.unregistered) {
    unregister_handlers(request);
  }
  for (EventHandler& handler : requests.handlers) {
    register_handler(std::move(handler));
  }
  for (TimerRequest& request : requests.timers) {
    start_timer(std::move(request));
  }
  std::vector<std::vector<Dependency>> dependencies(requests.processes.size());
  for (Dependency& dependency : requests.dependencies) {
    dependencies[dependency.process].push_back(std::move(dependency));
  }
  // Those that wait come first: they watch the others from their start on.
  for (std::size_t i = 0; i < requests.processes.size(); ++i) {
    if (!dependencies[i].empty()) {
      start_order_.add(std::move(requests.processes[i]), *round.processes[i], std::move(dependencies[i]));
      round.processes[i] = nullptr;
    }
  }
  if (!output_observed_ && (handlers_.watch_output() || start_order_.watch_output())) {
    output_observed_ = true;
    supervisor_.observe_output([this](const ProcessSpec& spec, ProcessId id, const std::string& label,
                                      OutputStream stream,
                                      std::string_view line) { on_line(spec, id, label, stream, line); });
  }
  for (std::size_t i = 0; i < requests.processes.size(); ++i) {
    if (round.processes[i] != nullptr && !shutting_down_) {
      start_process(std::move(requests.processes[i]), *round.processes[i]);
    }
  }
  timing_.push_back({fmt::format("start {} processes", requests.processes.size()), loop_.now() - before});
  start_ros_tasks(requests);
  for (const CoroutineRequest& request : requests.coroutines) {
    if (!shutting_down_) {
      coroutines_.start(request);
    }
  }
  if (requests.shutdown) {
    shutdown(requests.shutdown->reason);
  }
}

void LaunchService::start_process(ProcessSpec spec, TrackedProcess& process) {
  for (const auto& scope : active_scopes_) {
    scope->prepare(spec);
  }
  const ProcessId id = supervisor_.next_id();
  table_.bind(process, id, fmt::format("{}-{}", spec.name, id));
  for (const std::string& name : spec.other_names) {
    if (ros_tasks_ && name.starts_with('/')) {
      ros_tasks_->name_process(id, name);
    }
  }
  record({.kind = LaunchRecord::Kind::kSpawn, .name = spec.name, .where = spec.origin, .time = monotonic_time()});
  supervisor_.start(std::move(spec));
}

void LaunchService::start_timer(TimerRequest request) {
  timers_.push_back({std::move(request), nullptr});
  const auto timer = std::prev(timers_.end());
  timer->source = loop_.after(timer->request.period, [this, timer] { on_timer(timer); });
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

void LaunchService::execute(const ProcessCommand& command) {
  const std::vector<TrackedProcess*> named = table_.find(command.process);
  bool carried_out = false;
  for (const TrackedProcess* const process : named) {
    if (process->id == 0) {
      carried_out |= command.kind == ProcessCommand::Kind::kStop && start_order_.drop(*process);
    } else if (!process->is_over) {
      carried_out = true;
      send(command, process->id, supervisor_);
    }
  }
  if (carried_out) {
    return;
  }
  if (command.kind == ProcessCommand::Kind::kRestart && named.back()->id != 0) {
    supervisor_.restart(named.back()->id);
    return;
  }
  context_.message(LogLevel::kWarning, "launch",
                   fmt::format("{}: process '{}' does not run ({})", name_of(command.kind), command.process,
                               to_string(command.where)));
}

RunScope::Tell LaunchService::teller() {
  return [this](bool warning, const std::string& text) {
    context_.message(warning ? LogLevel::kWarning : LogLevel::kInfo, "launch.trace", text);
  };
}

}  // namespace launch
