// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/reload/reloads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <set>
#include <utility>
#include <variant>

#include "base/overloaded.hpp"

namespace launch {
namespace {

// The settings of a scope as one text. A time in a name differs in each reading, and may have a number behind it.
std::string text_of(const RunScope& scope) {
  static const std::regex time("[0-9]{14}(-[0-9]+)?");  // YYYYMMDDHHMMSS
  std::string text = scope.kind();
  const auto add = [&text](const std::string& value) { text += std::regex_replace(value, time, "") + '\n'; };
  for (const ShownSetting& setting : scope.describe()) {
    add(setting.name);
    std::visit(
        Overloaded{[&](bool value) { add(value ? "true" : "false"); },
                   [&](std::int64_t value) { add(std::to_string(value)); },
                   [&](const std::string& value) { add(value); },
                   [&](const std::vector<std::string>& values) { std::for_each(values.begin(), values.end(), add); }},
        setting.value);
  }
  return text;
}

std::vector<std::string> texts_of(const std::vector<RunScopePtr>& scopes) {
  std::vector<std::string> texts;
  for (const RunScopePtr& scope : scopes) {
    texts.push_back(text_of(*scope));
  }
  return texts;
}

}  // namespace

ReloadNumber Reloads::ask(Wish wish) {
  queue_.push_back({++last_, wish});
  proceed();
  return last_;
}

void Reloads::note(const Round& round) {
  if (!began_) {
    began_ = parts_.loop.now();
    traces_ = texts_of(round.requests.scopes);
    coroutines_ = round.requests.coroutines.size();
  }
  components_.note(round.requests);
  std::vector<DeclaredProcess> declared = declared_processes(round.requests);
  for (std::size_t i = 0; i < declared.size(); ++i) {
    known_.push_back({std::move(declared[i]), round.processes[i]});
  }
}

void Reloads::proceed() {
  if (queue_.empty() || posted_) {
    return;
  }
  posted_ = true;
  parts_.loop.post([this] {
    posted_ = false;
    begin();
  });
}

void Reloads::begin() {
  if (queue_.empty() || (!shut_down_ && (work_ || !began_ || !callbacks_.quiet()))) {
    return;
  }
  const Queued next = queue_.front();
  reload(next);
  queue_.pop_front();
  proceed();
  callbacks_.idle();
}

void Reloads::reload(const Queued& queued) {
  ReloadReport report{.number = queued.number, .only_shown = queued.wish.only_show};
  if (shut_down_) {
    report.refused = "the launch is ending, it does not reload any more";
  } else if (!load_) {
    report.refused = "this launch can't read its launch file again";
  }
  if (report.failed()) {
    tell(report);
    return;
  }
  const Duration begin = parts_.loop.now();
  try {
    FileReading reading(parts_.context, load_, begin - *began_, handled_);
    check_conditions(reading.requests().handlers, !traces_.empty());
    const ReloadView view{parts_.processes, parts_.supervisor,
                          [this](ProcessId id) { return parts_.steering.is_stopped(id); },
                          !queued.wish.restart && parts_.context.ros_client() != nullptr};
    ReloadPlan plan = plan_reload(known_, reading.requests(), view);
    report = report_of(queued, plan, reading.requests());
    report.took = parts_.loop.now() - begin;
    tell(report);
    if (!queued.wish.only_show) {
      reading.keep();
      say(report);
      carry_out(queued.number, std::move(plan), reading);
    }
  } catch (const LaunchError& error) {
    refuse(report, error);
  } catch (const std::exception& error) {
    refuse(report, LaunchError(error.what(), {}));
  }
}

void Reloads::refuse(ReloadReport& report, const LaunchError& error) {
  report.errors = error.diagnostics();
  if (!report.only_shown) {
    callbacks_.tell_error(error);
    parts_.context.message(LogLevel::kWarning, "launch",
                           "reload: nothing is changed, because the launch file has an error");
  }
  tell(report);
}

ReloadReport Reloads::report_of(const Queued& queued, const ReloadPlan& plan, const Requests& requests) const {
  ReloadReport report{.number = queued.number, .only_shown = queued.wish.only_show};
  for (std::size_t i = 0; i < plan.processes.size(); ++i) {
    const PlannedProcess& planned = plan.processes[i];
    ReloadReport::Line line{planned.label, planned.changes, plan.declared[i].where};
    switch (planned.fate) {
      case Fate::kStays:
        ++report.stays;
        break;
      case Fate::kTakesOver:
        report.takes_over.push_back(std::move(line));
        break;
      case Fate::kSets:
        report.sets.push_back(std::move(line));
        break;
      case Fate::kRestarts:
        report.restarts.push_back(std::move(line));
        break;
      case Fate::kStarts:
        report.starts.push_back(std::move(line));
        break;
    }
  }
  for (const std::string& label : plan.gone_labels) {
    report.ends.push_back({label, {}, {}});
  }
  components_.compare(requests, report);
  if (texts_of(requests.scopes) != traces_) {
    report.notes.emplace_back(
        "the trace of the launch file has changed: what is recorded goes on as it began; restart the launch to change "
        "it");
  }
  if (requests.coroutines.size() != coroutines_) {
    report.notes.emplace_back("coroutines of the launch file go on as they began; restart the launch to change them");
  }
  if (!requests.shutdowns.empty()) {
    report.notes.push_back(fmt::format("the launch file ends the launch now: {}", requests.shutdowns.back().reason));
  }
  return report;
}

void Reloads::carry_out(ReloadNumber number, ReloadPlan plan, FileReading& reading) {
  work_.emplace();
  work_->end.number = number;
  Requests& requests = reading.requests();
  parts_.handlers.clear();
  parts_.timers.clear_declared();
  for (TrackedProcess* const process : plan.gone) {
    end_process(*process);
  }
  std::set<std::string> new_containers;  // whose process ends or starts again
  for (const KnownProcess& known : known_) {
    if (known.process->is_gone) {
      new_containers.insert(known.declared.node);
    }
  }
  known_.clear();
  Requests rest;
  std::vector<std::optional<std::size_t>> moved(plan.processes.size());
  for (std::size_t i = 0; i < plan.processes.size(); ++i) {
    PlannedProcess& planned = plan.processes[i];
    ProcessSpec& spec = requests.processes[i];
    if (planned.fate == Fate::kStarts) {
      if (planned.process != nullptr) {
        parts_.processes.forget(*planned.process);
      }
      moved[i] = rest.processes.size();
      rest.processes.push_back(std::move(spec));
      continue;
    }
    const ProcessId id = planned.process->id;
    const Environment environment = planned.fate == Fate::kSets ? spec.environment : Environment();
    if (planned.needs_new_spec && id != 0) {
      parts_.processes.replace(*planned.process, std::move(spec));
    } else {
      parts_.processes.adopt(*planned.process, spec);
    }
    if (planned.needs_new_spec || parts_.processes.scalable(*planned.process) == nullptr) {
      parts_.scaling.replace_copies(*planned.process);
    }
    if (planned.fate == Fate::kRestarts) {
      restart(id, planned.label);
      new_containers.insert(plan.declared[i].node);
    } else if (planned.fate == Fate::kSets) {
      set_parameters(planned, plan.declared[i], environment);
    }
    known_.push_back({std::move(plan.declared[i]), planned.process});
  }
  components_.take_over(requests, [&](const std::string& name) { return new_containers.contains(name); });
  for (NodeDescription& node : requests.nodes) {
    if (moved[node.process]) {
      node.process = *moved[node.process];
      rest.nodes.push_back(std::move(node));
    }
  }
  for (Dependency& dependency : requests.dependencies) {
    if (moved[dependency.process]) {
      dependency.process = *moved[dependency.process];
      rest.dependencies.push_back(std::move(dependency));
    }
  }
  Requests reactions;
  reactions.handlers = std::move(requests.handlers);
  reactions.timers = std::move(requests.timers);
  callbacks_.carry_out(std::move(reactions));
  rest.shutdowns = std::move(requests.shutdowns);
  work_->rest = std::move(rest);
  go_on();
}

// Its end is no end of the launch, whatever the launch file said of it before.
void Reloads::end_process(TrackedProcess& process) {
  parts_.scaling.end_copies(process);
  parts_.processes.forget(process);
  parts_.steering.forget(process.id);
  if (process.id == 0 || process.is_over) {
    return;
  }
  const ProcessView view = parts_.supervisor.view(process.id);
  ProcessSpec quiet = view.spec;
  quiet.required = quiet.shutdown_on_exit = false;
  parts_.supervisor.adopt(process.id, quiet);
  work_->ending.emplace(process.id, view.label);
  parts_.supervisor.stop(process.id);
}

void Reloads::restart(ProcessId id, const std::string& label) {
  work_->restarting.emplace(id, label);
  parts_.supervisor.restart(id);
}

void Reloads::set_parameters(const PlannedProcess& planned, const DeclaredProcess& declared,
                             const Environment& environment) {
  const auto setting = settings_.insert(settings_.end(), {planned.process->id, planned.label, nullptr});
  setting->answer = parts_.context.ros_client()->ask(
      SetParameters{declared.node, planned.parameters}, environment, kPatience,
      [this, setting](const RosAnswer& answer) {
        const Setting answered = std::move(*setting);
        settings_.erase(setting);
        if (!answer.ok && work_) {
          parts_.context.message(
              LogLevel::kWarning, answered.label,
              fmt::format("its parameters can't be set while it runs: {}; it is started again", answer.error));
          if (parts_.supervisor.view(answered.id).pid >= 0) {
            restart(answered.id, answered.label);
          }
        }
        go_on();
      });
}

bool Reloads::has_asked_for(const ProcessEvent& event) const {
  return work_ && std::holds_alternative<ProcessExited>(event.what) &&
         (work_->ending.contains(event.id) || work_->restarting.contains(event.id));
}

void Reloads::on_event(const ProcessEvent& event) {
  if (!work_) {
    return;
  }
  if (std::holds_alternative<ProcessDone>(event.what)) {
    work_->ending.erase(event.id);
  }
  if (const auto restarting = work_->restarting.find(event.id); restarting != work_->restarting.end()) {
    const auto* const failed = std::get_if<ProcessStartFailed>(&event.what);
    const bool is_done = std::holds_alternative<ProcessDone>(event.what);
    if (failed != nullptr || is_done) {
      work_->end.failures.push_back(fmt::format("{} has not started{}", restarting->second,
                                                failed == nullptr ? std::string() : ": " + failed->reason));
    }
    if (failed != nullptr || is_done || std::holds_alternative<ProcessStarted>(event.what)) {
      work_->restarting.erase(restarting);
    }
  }
  parts_.loop.post([this] { go_on(); });
}

void Reloads::go_on() {
  if (!work_ || !work_->ending.empty()) {
    return;
  }
  if (work_->rest) {
    callbacks_.carry_out(*std::exchange(work_->rest, std::nullopt));
  }
  if (work_->restarting.empty() && settings_.empty()) {
    const ReloadEnd end = std::move(work_->end);
    work_.reset();
    for (const Observer& observer : observers_) {
      observer.end(end);
    }
    proceed();
    callbacks_.idle();
  }
}

void Reloads::shutdown() {
  shut_down_ = true;
  settings_.clear();
  if (work_) {
    ReloadEnd end = std::move(work_->end);
    work_.reset();
    end.failures.emplace_back("the launch is ending");
    for (const Observer& observer : observers_) {
      observer.end(end);
    }
  }
  proceed();
}

void Reloads::say(const ReloadReport& report) const {
  parts_.context.message(
      LogLevel::kInfo, "launch",
      report.changes_nothing() ? "reload: the launch file asks for what runs already" : "reload: " + summary(report));
  for (const std::string& note : report.notes) {
    parts_.context.message(LogLevel::kWarning, "launch", "reload: " + note);
  }
}

void Reloads::tell(const ReloadReport& report) {
  for (const Observer& observer : observers_) {
    observer.report(report);
  }
}

}  // namespace launch
