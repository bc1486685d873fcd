// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/launch_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "launcher/control/reload_lines.hpp"

namespace launch {
namespace {

using Kind = ControlRequest::Kind;

}  // namespace

LaunchControl::LaunchControl(EventLoop& loop, int listener, ProcessSupervisor& supervisor, Steering& steering,
                             LaunchFacts facts)
    : supervisor_(supervisor),
      steering_(steering),
      facts_(std::move(facts)),
      server_(loop, listener,
              {[this](ClientId client, std::string_view line) { take(client, line); },
               [this](ClientId client) { tell_dropped(client); }, [this](ClientId client) { forget(client); },
               [](std::string_view why) { return error_line(why); }}),
      attachments_(supervisor, server_) {
  supervisor_.observe([this](const ProcessEvent& event) {
    on_event(event);
    attachments_.on_event(event);
  });
  steering_.observe_end([this](const std::string& reason) { tell_followers(ending_line(reason)); });
}

void LaunchControl::use_reloads(Reloads& reloads) {
  reloads_ = &reloads;
  reloads.observe([this](const ReloadReport& report) { tell_followers(reload_line(report)); },
                  [this](const ReloadEnd& end) { tell_followers(reloaded_line(end)); });
}

LaunchControl::~LaunchControl() {
  supervisor_.observe_output_from_outside(nullptr);
  steering_.observe_end(nullptr);
}

void LaunchControl::take(ClientId client, std::string_view line) {
  ControlRequest request;
  try {
    request = parse_control_request(line);
  } catch (const std::runtime_error& error) {
    server_.send(client, error_line(error.what()));
    return;
  }
  if (request.kind == Kind::kAttach) {
    attach(client, request);
  } else if (request.kind == Kind::kInput) {
    attachments_.type(client, std::move(request.text));
  } else if (request.kind == Kind::kResize) {
    attachments_.resize(client, request.size);
  } else {
    server_.send(client, answer(client, std::move(request)));
  }
}

void LaunchControl::attach(ClientId client, const ControlRequest& request) {
  SteeringOutcome outcome;
  const std::vector<SteeredProcess> found = steering_.find({.patterns = request.processes}, outcome);
  if (found.size() > 1) {
    std::string names;
    for (const SteeredProcess& process : found) {
      names += (names.empty() ? "" : ", ") + process.name;
    }
    outcome.error = fmt::format("several processes are named '{}': {}", request.processes.front(), names);
    outcome.help = "name one of them";
  }
  if (outcome.error.empty()) {
    attachments_.attach(client, found.front(), request);
  } else {
    server_.send(client, outcome_line(outcome));
  }
}

std::string LaunchControl::answer(ClientId client, ControlRequest request) {
  switch (request.kind) {
    case Kind::kInfo:
      return info_line(facts_, steering_.is_ending());
    case Kind::kPs: {
      SteeringOutcome outcome;
      const std::vector<SteeredProcess> found = steering_.find({request.processes, request.groups}, outcome);
      return outcome.error.empty() ? ps_line(facts_, steering_.is_ending(), found, supervisor_) : outcome_line(outcome);
    }
    case Kind::kStop:
      return outcome_line(steering_.ask(Steering::Request::kStop, {request.processes, request.groups}));
    case Kind::kStart:
      return outcome_line(steering_.ask(Steering::Request::kStart, {request.processes, request.groups}));
    case Kind::kRestart:
      return outcome_line(steering_.ask(Steering::Request::kRestart, {request.processes, request.groups}));
    case Kind::kSignal:
      return outcome_line(
          steering_.ask(Steering::Request::kSignal, {request.processes, request.groups}, request.signal));
    case Kind::kShutdown:
      steering_.shutdown();
      return done_line();
    case Kind::kScale:
      return scale(request);
    case Kind::kReload:
      return reloads_ == nullptr
                 ? error_line("this launch can't read its launch file again")
                 : reload_answer_line(reloads_->ask({.only_show = request.dry_run, .restart = request.restart}));
    case Kind::kEvents:
    case Kind::kOutput:
      return follow(client, std::move(request));
    case Kind::kAttach:
    case Kind::kInput:
    case Kind::kResize:
      break;
  }
  return done_line();
}

std::string LaunchControl::scale(const ControlRequest& request) {
  if (scaling_ == nullptr || steering_.is_ending()) {
    return error_line(scaling_ == nullptr ? "the processes of this launch can't be scaled"
                                          : "the launch is ending, nothing can start any more");
  }
  return outcome_line(scaling_->scale(request.processes.front(), request.count));
}

std::string LaunchControl::follow(ClientId client, ControlRequest request) {
  if (request.kind == ControlRequest::Kind::kEvents) {
    followers_[client].events = true;
    return done_line();
  }
  SteeringOutcome outcome;
  if (!request.processes.empty()) {
    steering_.find({.patterns = request.processes}, outcome);
    if (!outcome.error.empty()) {
      return outcome_line(outcome);
    }
  }
  Follower& follower = followers_[client];
  follower.output = true;
  follower.processes = std::move(request.processes);
  watch_output();
  return follow_line(log_size());
}

void LaunchControl::forget(ClientId client) {
  followers_.erase(client);
  attachments_.forget(client);
  watch_output();
}

void LaunchControl::tell_dropped(ClientId client) {
  attachments_.on_room(client);
  if (const auto found = followers_.find(client); found != followers_.end() && found->second.dropped > 0) {
    server_.send(client, dropped_line(std::exchange(found->second.dropped, 0)));
  }
}

void LaunchControl::offer(ClientId client, Follower& follower, std::string_view line) {
  if (!server_.offer(client, line)) {
    ++follower.dropped;
  }
}

void LaunchControl::tell_followers(std::string_view line) {
  for (auto& [client, follower] : followers_) {
    if (follower.events) {
      offer(client, follower, line);
    }
  }
}

void LaunchControl::on_event(const ProcessEvent& event) {
  std::string line;
  for (auto& [client, follower] : followers_) {
    if (follower.events) {
      if (line.empty()) {
        line = event_line(event);
      }
      offer(client, follower, line);
    }
  }
}

void LaunchControl::on_line(const ProcessSpec& spec, ProcessId id, const std::string& label, OutputStream stream,
                            std::string_view text) {
  const auto wants = [&](const Follower& follower) {
    const SteeredProcess process{.id = id, .name = label, .names = names_of(spec)};
    return follower.output && (follower.processes.empty() ||
                               std::any_of(follower.processes.begin(), follower.processes.end(),
                                           [&](const std::string& pattern) { return matches(pattern, process); }));
  };
  std::string line;
  for (auto& [client, follower] : followers_) {
    if (wants(follower)) {
      if (line.empty()) {
        line = output_line(label, stream, text);
      }
      offer(client, follower, line);
    }
  }
}

// Lines are looked at only while a client wants them.
void LaunchControl::watch_output() {
  const bool wanted =
      std::any_of(followers_.begin(), followers_.end(), [](const auto& entry) { return entry.second.output; });
  if (wanted == watches_output_) {
    return;
  }
  watches_output_ = wanted;
  supervisor_.observe_output_from_outside(
      !wanted ? ProcessSupervisor::OutputObserver()
              : [this](const ProcessSpec& spec, ProcessId id, const std::string& label, OutputStream stream,
                       std::string_view line) { on_line(spec, id, label, stream, line); });
}

std::size_t LaunchControl::log_size() const {
  std::error_code unreadable;
  const std::uintmax_t size = std::filesystem::file_size(facts_.log_file, unreadable);
  return unreadable ? 0 : static_cast<std::size_t>(size);
}

}  // namespace launch
