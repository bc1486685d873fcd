// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/handlers/event_handlers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>

namespace launch {

void EventHandlers::add(EventHandler handler) {
  watch_output_ |= std::holds_alternative<OnProcessIo>(handler.event);
  std::string process = handler.process;
  by_process_[std::move(process)].push_back({count_++, std::make_shared<const EventHandler>(std::move(handler))});
}

namespace {

// The values that every event of a process has. An action of a Python launch file is known by a name of its own.
EventValues about(const ProcessSpec& spec, const std::string& label, EventValues more) {
  EventValues values = {{"process", label}};
  if (!spec.python_action.empty()) {
    values.emplace_back("action", spec.python_action);
  }
  values.insert(values.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  return values;
}

}  // namespace

bool EventHandlers::remove(const std::string& name) {
  std::size_t removed = 0;
  for (auto& [process, handlers] : by_process_) {
    removed += std::erase_if(handlers, [&](const Registered& each) { return each.handler->name == name; });
  }
  return removed != 0;
}

template <typename Concerned, typename Values>
std::vector<Invocation> EventHandlers::take(const ProcessSpec& spec, const std::string& label, Concerned concerned,
                                            Values values) {
  std::vector<std::string> names = names_of(spec);
  names.insert(names.end(), {label, ""});
  std::vector<Registered> found;
  for (const std::string& name : names) {
    const auto registered = by_process_.find(name);
    if (registered == by_process_.end()) {
      continue;
    }
    std::vector<Registered>& handlers = registered->second;
    std::copy_if(handlers.begin(), handlers.end(), std::back_inserter(found),
                 [&](const Registered& candidate) { return concerned(*candidate.handler); });
    std::erase_if(handlers, [&](const Registered& candidate) {
      return candidate.handler->once && concerned(*candidate.handler);
    });
  }
  std::sort(found.begin(), found.end(),
            [](const Registered& left, const Registered& right) { return left.number < right.number; });
  std::vector<Invocation> invocations;
  for (Registered& each : found) {
    invocations.push_back({std::move(each.handler), values()});
  }
  return invocations;
}

std::vector<Invocation> EventHandlers::on_event(const ProcessEvent& event) {
  if (by_process_.empty()) {
    return {};
  }
  if (const auto* const started = std::get_if<ProcessStarted>(&event.what)) {
    return take(
        event.spec, event.label,
        [](const EventHandler& handler) { return std::holds_alternative<OnProcessStart>(handler.event); },
        [&] {
          return about(event.spec, event.label, {{"pid", std::to_string(started->pid)}});
        });
  }
  const auto exit = [&](int code, const std::string& pid) {
    return take(
        event.spec, event.label,
        [code](const EventHandler& handler) {
          const auto* const wanted = std::get_if<OnProcessExit>(&handler.event);
          return wanted != nullptr && wanted->exit_code.matches(code);
        },
        [&] {
          return about(event.spec, event.label, {{"pid", pid}, {"exit_code", std::to_string(code)}});
        });
  };
  if (const auto* const exited = std::get_if<ProcessExited>(&event.what)) {
    return exit(exited->exit.code, std::to_string(exited->pid));
  }
  if (const auto* const change = std::get_if<HealthChanged>(&event.what)) {
    return take(
        event.spec, event.label,
        [change](const EventHandler& handler) {
          const auto* const wanted = std::get_if<OnHealthChange>(&handler.event);
          return wanted != nullptr && wanted->health.value_or(change->health) == change->health;
        },
        [&] {
          return about(
              event.spec, event.label,
              {{"pid", std::to_string(change->pid)}, {"health", name_of(change->health)}, {"reason", change->reason}});
        });
  }
  if (const auto* const reached = std::get_if<StartLimitReached>(&event.what)) {
    return take(
        event.spec, event.label,
        [](const EventHandler& handler) { return std::holds_alternative<OnStartLimit>(handler.event); },
        [&] {
          return about(event.spec, event.label, {{"starts", std::to_string(reached->starts)}});
        });
  }
  if (std::holds_alternative<ProcessStartFailed>(event.what)) {
    return exit(kExitCodeOfFailedStart, "");
  }
  return {};
}

std::vector<Invocation> EventHandlers::on_line(const ProcessSpec& spec, const std::string& label, OutputStream stream,
                                               std::string_view line) {
  if (!watch_output_) {
    return {};
  }
  return take(
      spec, label,
      [&](const EventHandler& handler) {
        const auto* const wanted = std::get_if<OnProcessIo>(&handler.event);
        return wanted != nullptr && wanted->pattern.matches(stream, line);
      },
      [&] {
        return about(spec, label,
                     {{"text", std::string(line)}, {"stream", stream == OutputStream::kOut ? "stdout" : "stderr"}});
      });
}

template <typename Event>
std::vector<Invocation> EventHandlers::take_of_machine(const std::string& machine, const EventValues& values) {
  const auto any = by_process_.find("");
  if (any == by_process_.end()) {
    return {};
  }
  std::vector<Invocation> invocations;
  std::erase_if(any->second, [&](const Registered& each) {
    const auto* const wanted = std::get_if<Event>(&each.handler->event);
    if (wanted == nullptr || (!wanted->machine.empty() && wanted->machine != machine)) {
      return false;
    }
    invocations.push_back({each.handler, values});
    return each.handler->once;
  });
  return invocations;
}

std::vector<Invocation> EventHandlers::on_lost_machine(const LostMachine& lost) {
  return take_of_machine<OnMachineLost>(
      lost.name, {{"machine", lost.name}, {"reason", lost.reason}, {"processes", lost.processes}});
}

std::vector<Invocation> EventHandlers::on_returned_machine(const ReturnedMachine& returned) {
  return take_of_machine<OnMachineBack>(
      returned.name, {{"machine", returned.name},
                      {"for", fmt::format("{:.1f}", std::chrono::duration<double>(returned.away).count())},
                      {"dropped", std::to_string(returned.dropped)}});
}

bool EventHandlers::has_on_shutdown() const {
  const auto any = by_process_.find("");
  return any != by_process_.end() && std::any_of(any->second.begin(), any->second.end(), [](const Registered& each) {
           return std::holds_alternative<OnShutdown>(each.handler->event);
         });
}

std::vector<Invocation> EventHandlers::on_shutdown(const std::string& reason) {
  std::vector<Invocation> invocations;
  if (const auto any = by_process_.find(""); any != by_process_.end()) {
    for (const Registered& each : any->second) {
      if (std::holds_alternative<OnShutdown>(each.handler->event)) {
        invocations.push_back({each.handler, {{"reason", reason}}});
      }
    }
  }
  return invocations;
}

}  // namespace launch
