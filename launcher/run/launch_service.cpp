// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/launch_service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/monotonic_clock.hpp"
#include "base/overloaded.hpp"
#include "launcher/process/guardian/guardian.hpp"

namespace launch {
namespace {

auto warn_or_tell(LaunchContext& context, const char* logger) {
  return [&context, logger](bool warning, const std::string& text) {
    context.message(warning ? LogLevel::kWarning : LogLevel::kInfo, logger, text);
  };
}

}  // namespace

LaunchService::LaunchService(LaunchContext& context, EventLoop& loop, ProcessSupervisor& supervisor, ErrorSink errors)
    : context_(context),
      loop_(loop),
      supervisor_(supervisor),
      errors_(std::move(errors)),
      signals_(loop, supervisor,
               {[this] { return on_lost_guardian(); }, [this](const std::string& signal) { on_interrupt(signal); },
                [this](int number, const std::string& signal) { on_interrupt_again(number, signal); },
                [this](const std::string& text) { context_.message(LogLevel::kInfo, "launch", text); }}),
      crashes_(loop, warn_or_tell(context, "launch")),
      health_(loop, supervisor, crashes_,
              {std::bind_front(&LaunchContext::message, &context_),
               [this](const std::string& reason) { shutdown(reason); }}),
      limits_(loop, std::bind_front(&LaunchContext::message, &context_)),
      scopes_(loop, warn_or_tell(context, "launch.trace"), timing_),
      rounds_(scopes_, {[this](Round round) { start(std::move(round)); },
                        [this](const LaunchError& error) { fail(error); }, [this] { check_finished(); }}),
      recording_(scopes_),
      processes_(
          loop, supervisor,
          {[this](ProcessSpec& spec, ProcessId id) { prepare(spec, id); },
           [this](const LaunchError& error) { fail(error); }, std::bind_front(&LaunchContext::message, &context_),
           [this](const TrackedProcess& process) {
             ros_tasks_.on_skipped(process.names);
             test_.on_skipped(process);
             post_check();
           },
           [this](const std::string& process, const Dependency& dependency) {
             recording_.record_ready(process, dependency);
           }}),
      test_(loop, supervisor, processes_,
            [this](const std::string& text) { context_.message(LogLevel::kWarning, "launch", text); }),
      steering_(supervisor, processes_,
                {[this] { return phase_ != Phase::kRunning; }, [this] { post_check(); },
                 [this](const std::string& reason) {
                   if (phase_ == Phase::kRunning) {
                     context_.message(LogLevel::kInfo, "launch", fmt::format("ending the launch, by {}", reason));
                     shutdown(reason);
                   }
                 },
                 [this](const std::string& text) { context_.message(LogLevel::kInfo, "launch", text); }}),
      process_usage_(loop, {[this](const std::string& name) { return processes_.running(name); },
                            [this] { return processes_.names(); }}),
      handlers_(
          loop, [this](const Invocation& invocation) { visit(invocation); }, [this] { check_finished(); },
          [this](const LaunchError& error) { fail(error); }),
      timers_(loop, [this](TimerRequest timer) { visit(std::move(timer)); }),
      scaling_(supervisor, processes_, [this](Requests requests) { carry_out(std::move(requests), Asker::kHandler); }),
      reloads_({context, loop, supervisor, processes_, handlers_, timers_, steering_, scaling_, ros_tasks_},
               {[this] { return rounds_.empty() && handlers_.idle(); },
                [this](Requests requests) { carry_out(std::move(requests), Asker::kFile); }, errors_,
                [this] { post_check(); }}),
      coroutines_(
          context, loop, [this] { on_coroutine_step(); }, [this](const LaunchError& error) { fail(error); }),
      ros_tasks_(
          context, loop, [this] { post_check(); }, [this](const LaunchError& error) { fail(error); }),
      farewell_(loop, {[this](const Invocation& invocation) { return visit_farewell(invocation); },
                       [this](const ProcessCommand& command) { processes_.execute(command); },
                       [this](ProcessSpec spec) {
                         farewell_.wait_for(supervisor_.next_id());
                         processes_.start_last(std::move(spec));
                       },
                       [this] { stop_processes(); },
                       [this](const std::string& text) { context_.message(LogLevel::kWarning, "launch", text); }}),
      hurry_(loop, supervisor, scopes_, crashes_, farewell_,
             [this](LogLevel level, const std::string& text) { context_.message(level, "launch", text); }) {
  supervisor_.observe([this](const ProcessEvent& event) { on_process_event(event); });
  scopes_.observe_snapshots(std::bind_front(&CrashCollector::on_snapshot, &crashes_));
  ros_tasks_.observe_failures(std::bind_front(&Outcome::on_component_failure, &outcome_));
}

void LaunchService::use_guardian(Guardian& guardian) {
  guardian_ = &guardian;
  limits_.use_guardian(guardian);
  scopes_.use_guardian(guardian);
}

int LaunchService::run(const LaunchDescription& description) {
  signals_.listen();
  context_.keep_beginning();
  loop_.post([this, &description] {
    const Duration before = loop_.now();
    traverse({description.file, 0, 0}, Asker::kFile, [&] {
      context_.visit(description);
      for (const MachineAssignment* const assignment : context_.machines().unused_assignments()) {
        context_.message(LogLevel::kWarning, "launch",
                         fmt::format("{}: no process of the launch fits this", to_string(assignment->where)));
      }
      for (const std::string& sentence : context_.machines().unused_commands()) {
        context_.message(LogLevel::kWarning, "launch", sentence);
      }
      timing_.push_back({"visit", loop_.now() - before});
    });
  });
  loop_.run();
  for (const std::string& line : outcome_.summary()) {
    context_.message(LogLevel::kError, "launch", line);
  }
  return outcome_.exit_code();
}

bool LaunchService::on_lost_guardian() {
  if (guardian_ == nullptr || guardian_missed_ || guardian_->is_alive()) {
    return false;
  }
  guardian_missed_ = true;
  context_.message(LogLevel::kError, "launch", "launch-guardian was killed: ending the launch");
  if (signals_.count_as_first()) {
    shutdown("the end of launch-guardian");
  }
  return true;
}

void LaunchService::on_interrupt(const std::string& name) {
  context_.message(LogLevel::kWarning, "launch", fmt::format("user interrupted with {}", name));
  shutdown(name);
}

void LaunchService::on_interrupt_again(int number, const std::string& name) {
  outcome_.on_hurry(number);
  timers_.clear();
  coroutines_.abandon();
  ros_tasks_.shutdown();
  hurry_.on_signal(name, phase_ == Phase::kFarewell);
  check_finished();
}

void LaunchService::on_process_event(const ProcessEvent& event) {
  recording_.record(event);
  outcome_.on_process_event(event);
  crashes_.on_process_event(event);
  health_.on_event(event);
  limits_.on_event(event);
  processes_.on_event(event);
  test_.on_event(event);
  steering_.on_event(event);
  if (!reloads_.has_asked_for(event)) {
    handlers_.on_event(event);
  }
  reloads_.on_event(event);
  on_end_of_required(event);
  ros_tasks_.on_process_event(event);
  check_started();
  if (std::holds_alternative<ProcessDone>(event.what)) {
    farewell_.on_done(event.id);
    post_check();
  }
}

void LaunchService::on_end_of_required(const ProcessEvent& event) {
  if (phase_ != Phase::kRunning || !ends_launch(event)) {
    return;
  }
  context_.message(LogLevel::kInfo, "launch",
                   fmt::format("process[{}] was required: shutting down launched system", event.label));
  outcome_.on_end_by(event);
  shutdown(fmt::format("process[{}] was required", event.label));
}

void LaunchService::on_coroutine_step() {
  Requests requests = context_.take_requests();
  if (requests.empty()) {
    check_finished();
  } else {
    carry_out(std::move(requests), Asker::kHandler);
  }
}

// A traversal, from the visit to the start of its processes.

void LaunchService::visit(TimerRequest timer) {
  const std::vector<ActionPtr>& actions = timer.actions;
  traverse(actions.empty() ? SourceRange() : actions.front()->where(),
           timer.by_handler ? Asker::kHandler : Asker::kFile,
           [&] { context_.visit_in(std::move(timer.scope), actions); });
}

void LaunchService::visit(const Invocation& invocation) {
  const std::vector<ActionPtr>& actions = invocation.handler->actions;
  const EventHandler& handler = *invocation.handler;
  reloads_.note(invocation);
  traverse(actions.empty() ? SourceRange() : actions.front()->where(),
           std::holds_alternative<OnceReady>(handler.event) && !handler.by_handler ? Asker::kFile : Asker::kHandler,
           [&] { context_.visit(invocation); });
}

void LaunchService::on_lost_machine(const LostMachine& lost) {
  if (phase_ == Phase::kRunning) {
    handlers_.on_lost_machine(lost);
  }
}

void LaunchService::use_condition_watch(ConditionWatch& watch) {
  handlers_.use_condition_watches(
      watch, process_usage_,
      {[this](LogLevel level, const std::string& text) { context_.message(level, "launch.condition", text); },
       [this](const ConditionEvent& event) {
         recording_.record(event);
         if (on_condition_) {
           on_condition_(event);
         }
       }});
}

void LaunchService::on_returned_machine(const ReturnedMachine& returned) {
  if (phase_ == Phase::kRunning) {
    handlers_.on_returned_machine(returned);
  }
}

void LaunchService::traverse(const SourceRange& where, Asker asker, const std::function<void()>& traversal) {
  const std::int64_t begin = monotonic_time();
  try {
    traversal();
    context_.machines().check_files();
  } catch (const LaunchError& error) {
    context_.machines().forget_files();
    context_.take_requests();
    fail(error);
    return;
  }
  Requests requests = context_.take_requests();
  recording_.record_visit(begin, where, requests);
  if (asker == Asker::kHandler) {
    std::for_each(requests.timers.begin(), requests.timers.end(), [](TimerRequest& timer) { timer.by_handler = true; });
    std::for_each(requests.handlers.begin(), requests.handlers.end(),
                  [](EventHandler& each) { each.by_handler = true; });
  }
  carry_out(std::move(requests), asker);
}

void LaunchService::carry_out(Requests requests, Asker asker) {
  if (phase_ != Phase::kRunning) {
    check_finished();
    return;
  }
  has_trace_ = has_trace_ || std::any_of(requests.scopes.begin(), requests.scopes.end(),
                                         [](const RunScopePtr& scope) { return scope->kind() == "trace"; });
  Round round;
  try {
    check_conditions(requests.handlers, has_trace_);
    round = processes_.enter(std::move(requests));
  } catch (const LaunchError& error) {
    fail(error);
    return;
  }
  if (asker == Asker::kFile) {
    reloads_.note(round);
  }
  rounds_.add(std::move(round));
}

void LaunchService::start(Round given) {
  const auto round = std::make_shared<Round>(std::move(given));
  std::vector<ProcessCommand> later = processes_.take_later(*round);
  const auto goes_on = [this] { return phase_ == Phase::kRunning; };
  recording_.begin();
  const Overloaded carry_out{
      [&](std::vector<ProcessCommand>& commands) {
        std::for_each(commands.begin(), commands.end(), std::bind_front(&Processes::execute, &processes_));
      },
      [&](std::vector<UnregisterRequest>& requests) {
        handlers_.unregister(requests, std::bind_front(warn_or_tell(context_, "launch"), true));
      },
      [&](std::vector<TestRequest>& tests) { test_.begin(std::move(tests), context_.scope().log_directory); },
      [&](std::vector<EventHandler>& handlers) {
        for (EventHandler& handler : handlers) {
          handlers_.add(std::move(handler), context_.ros_client());
        }
      },
      [&](std::vector<TimerRequest>& timers) {
        std::for_each(timers.begin(), timers.end(), [&](auto& timer) { timers_.start(std::move(timer)); });
      },
      [&](std::vector<LoadRequest>& loads) { ros_tasks_.start(std::move(loads), {}); },
      [&](std::vector<TransitionRequest>& transitions) { ros_tasks_.start({}, std::move(transitions)); },
      [&](std::vector<ProcessSpec>& processes) {
        for (const ProcessSpec& spec : processes) {
          crashes_.expect(spec);
          health_.monitor.expect(spec);
        }
        processes_.wait(*round);
        observe_output();
      },
      PassOver<std::vector<CoroutineRequest>, std::vector<ShutdownRequest>>(),  // when all have started
      PassOver<std::vector<RunScopePtr>>(),                                     // they have begun (rounds.hpp)
      PassOver<std::vector<NodeDescription>, std::vector<Dependency>>(),        // with the processes
  };
  for_each_kind(round->requests, [&](auto& kind) {
    if (goes_on()) {  // a command may have ended the launch
      carry_out(kind);
    }
  });
  processes_.start(*round, [this, round, goes_on, later = std::move(later), before = loop_.now()] {
    std::for_each(later.begin(), later.end(), std::bind_front(&Processes::execute, &processes_));
    if (goes_on()) {
      timing_.push_back({fmt::format("start {} processes", round->requests.processes.size()), loop_.now() - before});
    }
    for (const CoroutineRequest& coroutine : round->requests.coroutines) {
      if (goes_on()) {
        coroutines_.start(coroutine);
      }
    }
    if (goes_on() && !round->requests.shutdowns.empty()) {
      shutdown(round->requests.shutdowns.back().reason);
    }
    rounds_.started();
  });
}

void LaunchService::observe_output() {
  if (!handlers_.watch_output() && !processes_.watch_output() && !crashes_.watch_output() && !test_.watch_output() &&
      !health_.monitor.watch_output()) {
    return;
  }
  supervisor_.observe_output([this](const ProcessSpec& spec, ProcessId id, const std::string& label,
                                    OutputStream stream, std::string_view line) {
    processes_.on_line(id, stream, line);
    handlers_.on_line(spec, label, stream, line);
    crashes_.on_line(spec, id, line);
    health_.monitor.on_line(id, stream, line);
    test_.on_line(spec, id, label, stream, line);
  });
}

void LaunchService::prepare(ProcessSpec& spec, ProcessId id) {
  health_.monitor.prepare(spec, id);
  if (spec.machine.empty()) {  // what these add to a process is on this machine
    limits_.prepare(spec, id);
  }
  scopes_.prepare(spec);
  if (spec.machine.empty()) {
    test_.prepare(spec, id);
  }
  ros_tasks_.name_process(id, spec.other_names);
  record({.kind = LaunchRecord::Kind::kSpawn, .name = spec.name, .where = spec.origin, .time = monotonic_time()});
}

}  // namespace launch
