// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/reload/file_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <variant>

namespace launch {
namespace {

// The processes to which a handler of Python listens have other names in each reading, so its line has to do.
std::string key_of(const EventHandler& handler) {
  if (!handler.live || !handler.where) {
    return handler.name + " " + describe(handler);
  }
  return std::string(handler.where.file->line(handler.where.file->position(handler.where.begin).line));
}

bool is_once_ready(const EventHandler& handler) {
  return std::holds_alternative<OnceReady>(handler.event);
}

template <typename Item>
void append(std::vector<Item>& to, std::vector<Item>& from) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

}  // namespace

void HandledOnce::note(const EventHandler& handler) {
  if (!handler.by_handler && (handler.once || is_once_ready(handler))) {
    ++handled_[key_of(handler)];
  }
}

bool HandledOnce::take(const EventHandler& handler) {
  if (!handler.once && !is_once_ready(handler)) {
    return false;
  }
  const auto found = taken_.find(key_of(handler));
  return found != taken_.end() && found->second > 0 && found->second-- > 0;
}

FileReading::FileReading(LaunchContext& context, const Load& load, Duration elapsed, HandledOnce& handled)
    : context_(context),
      before_(context.begin_again([this](LogLevel level, std::string_view logger, std::string_view text) {
        messages_.push_back({level, std::string(logger), std::string(text)});
      })) {
  try {
    visit(load, elapsed, handled);
    context_.machines().check_files();
  } catch (...) {
    context_.machines().forget_files();
    context_.put_back(std::move(before_));
    throw;
  }
}

FileReading::~FileReading() {
  if (!kept_) {
    context_.put_back(std::move(before_));
  }
}

void FileReading::keep() {
  kept_ = true;
  context_.put_back(std::move(before_.messages));
  for (const Message& message : messages_) {
    if (message.level >= LogLevel::kWarning) {
      context_.message(message.level, message.logger, message.text);
    }
  }
}

void FileReading::visit(const Load& load, Duration elapsed, HandledOnce& handled) {
  description_ = load();
  context_.visit(*description_);
  handled.begin();
  std::deque<std::pair<Requests, Duration>> visited;  // with the time from the beginning
  visited.emplace_back(context_.take_requests(), 0);
  check_names(visited.front().first);
  bool is_first = true;
  while (!visited.empty()) {
    auto [requests, now] = std::move(visited.front());
    visited.pop_front();
    std::vector<TimerRequest> timers = std::exchange(requests.timers, {});
    for (TimerRequest& timer : timers) {
      if (now + timer.period > elapsed) {
        timer.period -= elapsed - now;
        requests.timers.push_back(std::move(timer));
      } else {
        context_.visit_in(std::move(timer.scope), timer.actions);
        visited.emplace_back(context_.take_requests(), now + timer.period);
      }
    }
    std::vector<EventHandler> handlers = std::exchange(requests.handlers, {});
    for (EventHandler& handler : handlers) {
      if (!handled.take(handler)) {
        requests.handlers.push_back(std::move(handler));
      } else if (is_once_ready(handler)) {
        context_.visit(Invocation{std::make_shared<const EventHandler>(std::move(handler)), {}});
        visited.emplace_back(context_.take_requests(), now);
      }
    }
    if (!std::exchange(is_first, false)) {
      requests.shutdowns.clear();
      requests.transitions.clear();
    }
    add(std::move(requests));
  }
}

void FileReading::add(Requests requests) {
  const std::size_t first = requests_.processes.size();
  for (NodeDescription& node : requests.nodes) {
    node.process += first;
  }
  for (Dependency& dependency : requests.dependencies) {
    dependency.process += first;
  }
  append(requests_.scopes, requests.scopes);
  append(requests_.handlers, requests.handlers);
  append(requests_.timers, requests.timers);
  append(requests_.loads, requests.loads);
  append(requests_.transitions, requests.transitions);
  append(requests_.processes, requests.processes);
  append(requests_.coroutines, requests.coroutines);
  append(requests_.shutdowns, requests.shutdowns);
  append(requests_.nodes, requests.nodes);
  append(requests_.dependencies, requests.dependencies);
}

void check_names(const Requests& requests) {
  ProcessTable table;
  std::vector<TrackedProcess*> processes;
  for (const ProcessSpec& spec : requests.processes) {
    processes.push_back(&table.add(spec));
  }
  std::vector<Dependency> dependencies = requests.dependencies;
  resolve_dependencies(dependencies, processes, table);
  check_commands(requests.commands, table);
}

}  // namespace launch
