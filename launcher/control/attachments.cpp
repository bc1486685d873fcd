// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/attachments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "launcher/process/tty/process_tty.hpp"

namespace launch {
namespace {

constexpr std::size_t kUsualLines = 24;

// Why nobody can attach to the process; "": it is possible.
std::string why_not(const SteeredProcess& process, const ProcessSupervisor& supervisor) {
  if (const std::string& machine = process.id == 0 ? "" : supervisor.view(process.id).spec.machine; !machine.empty()) {
    return error_line(fmt::format("'{}' runs on machine '{}', whose terminals are not reached", process.name, machine));
  }
  if (!process.tty) {
    return error_line(fmt::format("'{}' has no terminal of its own ({})", process.name, to_string(process.origin)),
                      "write tty=\"true\" there, and let launch reload restart it");
  }
  if (process.id == 0) {
    return error_line(fmt::format("'{}' has not been started yet", process.name));
  }
  if (const ProcessTty* const tty = supervisor.tty(process.id); tty != nullptr && tty->is_open()) {
    return "";
  }
  const bool comes_back = supervisor.state(process.id) == ProcessState::kRespawnDelay;
  return error_line(fmt::format("'{}' does not run", process.name),
                    comes_back ? "it starts again by itself" : "launch start starts it");
}

}  // namespace

Attachments::~Attachments() {
  while (!attached_.empty()) {
    forget(attached_.begin()->first);
  }
}

void Attachments::attach(ClientId client, const SteeredProcess& process, const ControlRequest& request) {
  std::string refusal =
      attached_.contains(client) ? error_line("this client is attached already") : why_not(process, supervisor_);
  if (!refusal.empty()) {
    server_.send(client, refusal);
    return;
  }
  server_.allow_pauses(client);
  server_.send(client, attached_line(process.name, supervisor_.tty(process.id)->path(), clients_of(process.id)));
  const Attached& attached =
      attached_.emplace(client, Attached{process.id, request.read_only, request.size}).first->second;
  watch(process.id);
  if (const std::string shown = picture(attached); !shown.empty()) {
    server_.send(client, terminal_line(shown));
  }
  if (!request.read_only) {
    supervisor_.tty(process.id)->resize(request.size);
  }
}

void Attachments::resize(ClientId client, const TerminalSize& size) {
  const auto found = attached_.find(client);
  if (found == attached_.end()) {
    server_.send(client, error_line("this client is not attached to a terminal"));
    return;
  }
  found->second.size = size;
  if (!found->second.read_only) {
    supervisor_.tty(found->second.process)->resize(size);
  }
  server_.send(client, done_line());
}

void Attachments::type(ClientId client, std::string text) {
  const auto found = attached_.find(client);
  const auto typed_before = [&] {
    const std::deque<Typed>& waiting = typed_[found->second.process];
    return std::any_of(waiting.begin(), waiting.end(), [&](const Typed& typed) { return typed.client == client; });
  };
  if (found == attached_.end()) {
    server_.send(client, error_line("this client is not attached to a terminal"));
  } else if (found->second.read_only) {
    server_.send(client, error_line("this client only looks on"));
  } else if (typed_before()) {
    server_.send(client, error_line("the terminal has not taken the input before"));
  } else {
    std::deque<Typed>& waiting = typed_[found->second.process];
    waiting.push_back({client, std::move(text)});
    if (waiting.size() == 1) {
      type_on(found->second.process);
    }
  }
}

void Attachments::type_on(ProcessId process) {
  std::deque<Typed>& waiting = typed_[process];
  ProcessTty* const tty = supervisor_.tty(process);
  while (!waiting.empty()) {
    Typed& first = waiting.front();
    if (tty == nullptr || !tty->is_open()) {
      server_.send(first.client, error_line("the process has ended"));
      waiting.pop_front();
      continue;
    }
    first.taken += tty->type(std::string_view(first.text).substr(first.taken));
    if (first.taken < first.text.size()) {
      tty->when_room([this, process] { type_on(process); });
      return;
    }
    server_.send(first.client, taken_line(first.taken));
    waiting.pop_front();
  }
}

void Attachments::on_output(ProcessId process, std::string_view bytes) {
  std::string line;
  for (auto& [client, attached] : attached_) {
    if (attached.process != process) {
      continue;
    }
    if (line.empty()) {
      line = terminal_line(bytes);
    }
    // After a gap, nothing until the queue has room: then the last lines follow.
    if (attached.dropped > 0 || !server_.offer(client, line)) {
      attached.dropped += bytes.size();
    }
  }
}

void Attachments::on_room(ClientId client) {
  if (const auto found = attached_.find(client); found != attached_.end()) {
    show_rest(client, found->second);
  }
}

void Attachments::show_rest(ClientId client, Attached& attached) {
  if (attached.dropped > 0) {
    server_.send(client, terminal_dropped_line(std::exchange(attached.dropped, 0)));
    server_.send(client, terminal_line(picture(attached)));
  }
}

std::string Attachments::picture(const Attached& attached) const {
  const ProcessTty& tty = *supervisor_.tty(attached.process);
  return attached.size.lines == 0 ? std::string(tty.last_lines(kUsualLines)) : tty.picture(attached.size.lines);
}

void Attachments::forget(ClientId client) {
  const auto found = attached_.find(client);
  if (found == attached_.end()) {
    return;
  }
  const ProcessId process = found->second.process;
  attached_.erase(found);
  std::deque<Typed>& waiting = typed_[process];
  const bool is_first = !waiting.empty() && waiting.front().client == client;
  std::erase_if(waiting, [&](const Typed& typed) { return typed.client == client; });
  watch(process);
  if (is_first) {
    type_on(process);
  }
}

void Attachments::on_event(const ProcessEvent& event) {
  if (const auto* const exited = std::get_if<ProcessExited>(&event.what)) {
    end(event, exited);
  } else if (std::holds_alternative<ProcessLeft>(event.what)) {
    end(event, nullptr);
  }
}

void Attachments::end(const ProcessEvent& event, const ProcessExited* exited) {
  for (auto entry = attached_.begin(); entry != attached_.end();) {
    auto& [client, attached] = *entry;
    if (attached.process != event.id) {
      ++entry;
      continue;
    }
    show_rest(client, attached);
    server_.send(client, terminal_ended_line(event.label, exited));
    entry = attached_.erase(entry);
  }
  typed_.erase(event.id);
  watch(event.id);
}

// Output is looked at only while somebody is attached.
void Attachments::watch(ProcessId process) {
  ProcessTty* const tty = supervisor_.tty(process);
  if (tty == nullptr) {
    return;
  }
  if (clients_of(process) == 0) {
    tty->observe(nullptr);
  } else {
    tty->observe([this, process](std::string_view bytes) { on_output(process, bytes); });
  }
}

std::size_t Attachments::clients_of(ProcessId process) const {
  return static_cast<std::size_t>(std::count_if(attached_.begin(), attached_.end(),
                                                [&](const auto& entry) { return entry.second.process == process; }));
}

}  // namespace launch
