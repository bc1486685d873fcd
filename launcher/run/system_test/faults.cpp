// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/system_test/faults.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>
#include <utility>
#include <variant>

namespace launch {

struct Faults::Fault {
  explicit Fault(FaultRequest given) : request(std::move(given)) {}

  FaultRequest request;
  std::vector<DependencyWatches::WatchPtr> watches{};
  std::size_t open = 0;  // conditions that do not hold yet
  bool is_over = false;
  EventLoop::SourcePtr timer{};  // its begin, then its end
  std::uint64_t messages = 0;    // that were hit

  std::optional<std::size_t> impairment = std::nullopt;  // of the network, while it lasts
  bool fills_disk = false;                               // now

  const NetworkFault* of_network() const { return std::get_if<NetworkFault>(&request.what); }
  const DiskFault* of_disk() const { return std::get_if<DiskFault>(&request.what); }
  const MessageFault* of_messages() const { return std::get_if<MessageFault>(&request.what); }
  bool of_processes() const { return of_network() == nullptr && of_disk() == nullptr && of_messages() == nullptr; }
};

Faults::Faults(EventLoop& loop, ProcessSupervisor& supervisor, Processes& processes,
               std::function<void(const std::string&)> log)
    : loop_(loop),
      supervisor_(supervisor),
      processes_(processes),
      log_(std::move(log)),
      watches_(loop),
      process_faults_(loop, supervisor),
      messages_(loop, [this] {
        for (Fault& fault : faults_) {
          on_messages(fault);
        }
      }) {}

Faults::~Faults() = default;

void Faults::start(std::vector<FaultRequest> faults, const std::string& directory) {
  std::string no_messages;
  try {
    messages_.begin(faults, directory);
  } catch (const std::system_error& error) {
    no_messages = error.what();
  }
  for (FaultRequest& request : faults) {
    if (!request.left_out.empty()) {
      continue;
    }
    Fault& fault = faults_.emplace_back(std::move(request));
    fault.open = fault.request.dependencies.size();
    if (fault.of_messages() != nullptr && !no_messages.empty()) {
      miss(fault, no_messages);
      continue;
    }
    if (fault.open == 0) {
      begin(fault);
    }
    for (const Dependency& dependency : fault.request.dependencies) {
      fault.watches.push_back(watches_.begin(
          dependency, [this, &fault](const std::optional<std::string>& failure) { decide(fault, failure); }));
    }
  }
}

void Faults::decide(Fault& fault, const std::optional<std::string>& failure) {
  if (fault.is_over) {
    return;
  }
  if (failure) {
    miss(fault, *failure);
  } else if (--fault.open == 0) {
    begin(fault);
  }
}

void Faults::begin(Fault& fault) {
  if (!fault.of_processes() && fault.request.at == Duration(0)) {
    apply(fault);  // before the processes start, so that the first message counts
    return;
  }
  fault.timer = loop_.after(fault.request.at, [this, &fault] { apply(fault); });
}

void Faults::apply(Fault& fault) {
  fault.timer.reset();
  if (fault.of_messages() != nullptr) {
    apply_to_messages(fault);
  } else if (fault.of_network() != nullptr) {
    apply_to_network(fault);
  } else if (fault.of_disk() != nullptr) {
    apply_to_disk(fault);
  } else {
    apply_to_processes(fault);
  }
}

void Faults::apply_to_processes(Fault& fault) {
  FaultEvent event;
  std::vector<ProcessId> running;
  for (const TrackedProcess* const process : processes_.find(fault.request.process)) {
    if (process->id != 0 && supervisor_.view(process->id).pid >= 0) {
      running.push_back(process->id);
      event.labels.push_back(supervisor_.view(process->id).label);
    }
  }
  if (running.empty()) {
    miss(fault, fmt::format("'{}' did not run", fault.request.process));
    return;
  }
  if (const auto* const kill = std::get_if<KillFault>(&fault.request.what)) {
    event.signal = kill->signal;
  }
  log_begin(fault);
  tell(fault, event);
  const std::string reason = process_faults_.apply(fault.request, running);
  if (!reason.empty()) {
    miss(fault, reason);
    return;
  }
  await_end(fault);
}

void Faults::apply_to_messages(Fault& fault) {
  messages_.arm(fault.request.number, true);
  if (fault.request.lasts) {
    await_end(fault);  // else it is over when it has hit as many messages as it says
  }
}

void Faults::apply_to_network(Fault& fault) {
  if (network_ == nullptr) {
    miss(fault, "there is no network for it");
    return;
  }
  log_begin(fault);
  fault.impairment = network_->begin(*fault.of_network());
  tell(fault, {});
  await_end(fault);
}

void Faults::apply_to_disk(Fault& fault) {
  log_begin(fault);
  try {
    if (disks_ == nullptr) {
      throw std::runtime_error("there is no disk for it");
    }
    disks_->fill(fault.request.number, *fault.of_disk());
  } catch (const std::runtime_error& error) {
    miss(fault, error.what());
    return;
  }
  fault.fills_disk = true;
  tell(fault, {});
  await_end(fault);
}

// A fault that has been applied and has no end goes on, but nothing waits for it.
void Faults::await_end(Fault& fault) {
  if (fault.request.lasts) {
    fault.timer = loop_.after(*fault.request.lasts, [this, &fault] { end(fault); });
  } else {
    tell(fault, {.kind = FaultEvent::Kind::kOver});
  }
}

void Faults::end(Fault& fault) {
  fault.timer.reset();
  if (fault.of_messages() != nullptr) {
    end_messages(fault, " in that time");
  } else if (fault.of_network() != nullptr) {
    end_network(fault);
  } else if (fault.of_disk() != nullptr) {
    end_disk(fault);
  } else {
    process_faults_.end(fault.request);
    fault.is_over = true;
    tell(fault, {.kind = FaultEvent::Kind::kOver});
  }
}

// Tells what the nodes have done since the last call.
void Faults::on_messages(Fault& fault) {
  const MessageFault* const messages = fault.of_messages();
  if (messages == nullptr || fault.is_over) {
    return;
  }
  const MessageFaults::Hits hits = messages_.hits(fault.request.number);
  if (hits.hit == fault.messages) {
    return;
  }
  if (fault.messages == 0) {
    log_begin(fault);
  }
  fault.messages = hits.hit;
  tell(fault, {.messages = hits.hit, .first = hits.first, .latest = hits.latest});
  if (!fault.request.lasts && hits.hit >= messages->count.value_or(1)) {
    // One without an end goes on, but nothing waits for it.
    fault.is_over = messages->count.has_value();
    tell(fault, {.kind = FaultEvent::Kind::kOver});
  }
}

void Faults::end_messages(Fault& fault, const char* when) {
  messages_.arm(fault.request.number, false);
  on_messages(fault);
  if (fault.is_over) {
    return;
  }
  if (fault.messages > 0) {
    fault.is_over = true;
    tell(fault, {.kind = FaultEvent::Kind::kOver});
    return;
  }
  const MessageFault& messages = *fault.of_messages();
  const std::uint64_t seen = messages_.hits(fault.request.number).messages;
  miss(fault, fmt::format("there {} {} {}{}", seen == 1 ? "was" : "were", seen == 0 ? "no" : std::to_string(seen),
                          describe_messages(messages, seen != 1), when));
}

void Faults::end_network(Fault& fault) {
  if (fault.impairment) {
    network_->end(*fault.impairment);
    tell(fault, {.kind = FaultEvent::Kind::kOver, .packets = network_->packets(*fault.impairment)});
    fault.impairment.reset();
  }
  fault.is_over = true;
}

void Faults::end_disk(Fault& fault) {
  if (!std::exchange(fault.fills_disk, false)) {
    return;
  }
  try {
    disks_->make_room(fault.request.number);
  } catch (const std::runtime_error& error) {
    log_(fmt::format("fault {}: the disk stays full: {}", fault.request.number, error.what()));
  }
  fault.is_over = true;
  tell(fault, {.kind = FaultEvent::Kind::kOver});
}

void Faults::log_begin(const Fault& fault) const {
  log_(fmt::format("fault {}: {}", fault.request.number, describe(fault.request)));
}

void Faults::miss(Fault& fault, const std::string& reason) {
  fault.is_over = true;
  fault.timer.reset();
  log_(fmt::format("fault {}: {} can't be applied: {}", fault.request.number, describe(fault.request), reason));
  tell(fault, {.kind = FaultEvent::Kind::kMissed, .reason = reason});
}

void Faults::tell(const Fault& fault, FaultEvent event) const {
  if (observer_) {
    event.number = fault.request.number;
    observer_(event);
  }
}

void Faults::on_event(const ProcessEvent& event) {
  if (std::holds_alternative<ProcessExited>(event.what)) {
    process_faults_.on_exit(event.id);
  }
  if (const TrackedProcess* const process = processes_.find(event.id)) {
    watches_.on_process_event(*process);
  }
}

void Faults::on_line(ProcessId id, OutputStream stream, std::string_view line) {
  if (const TrackedProcess* const process = watch_output() ? processes_.find(id) : nullptr) {
    watches_.on_line(*process, stream, line);
  }
}

void Faults::shutdown() {
  for (Fault& fault : faults_) {
    if (fault.of_messages() != nullptr && !fault.is_over) {
      end_messages(fault, "");
    }
    end_network(fault);
    end_disk(fault);
    fault.is_over = true;
    fault.timer.reset();
    fault.watches.clear();
  }
  process_faults_.shutdown();
}

}  // namespace launch
