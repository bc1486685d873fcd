// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/system_test/faults.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <stdexcept>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>

#include "launcher/visit/clock_process.hpp"

namespace launch {

namespace {

// A slow process runs and stands still once in this time.
constexpr Duration kTurn = std::chrono::milliseconds(100);
constexpr unsigned kWhole = 100;  // percent

}  // namespace

struct Faults::Fault {
  explicit Fault(FaultRequest given) : request(std::move(given)) {}

  // A soft limit of a process as it was.
  struct Limit {
    ProcessId id;
    int resource;
    std::uint64_t before;
  };

  FaultRequest request;
  std::vector<DependencyWatches::WatchPtr> watches{};
  std::size_t open = 0;  // conditions that do not hold yet
  bool is_over = false;
  EventLoop::SourcePtr timer{};       // its begin, then its end
  EventLoop::SourcePtr turn_timer{};  // of a slow process
  std::vector<ProcessId> processes{};
  std::vector<Limit> limits{};
  std::uint64_t messages = 0;  // that were hit

  std::optional<std::size_t> impairment = std::nullopt;  // of the network, while it lasts
  bool fills_disk = false;                               // now

  const NetworkFault* of_network() const { return std::get_if<NetworkFault>(&request.what); }
  const DiskFault* of_disk() const { return std::get_if<DiskFault>(&request.what); }
  const MessageFault* of_messages() const { return std::get_if<MessageFault>(&request.what); }
};

Faults::Faults(EventLoop& loop, ProcessSupervisor& supervisor, Processes& processes,
               std::function<void(const std::string&)> log)
    : loop_(loop),
      supervisor_(supervisor),
      processes_(processes),
      log_(std::move(log)),
      watches_(loop),
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
  if (fault.of_messages() != nullptr && fault.request.at == Duration(0)) {
    apply_to_messages(fault);  // before the processes start, so that the first message counts
    return;
  }
  if (fault.of_network() != nullptr && fault.request.at == Duration(0)) {
    apply_to_network(fault);
    return;
  }
  if (fault.of_disk() != nullptr && fault.request.at == Duration(0)) {
    apply_to_disk(fault);
    return;
  }
  fault.timer = loop_.after(fault.request.at, [this, &fault] { apply(fault); });
}

void Faults::apply(Fault& fault) {
  fault.timer.reset();
  if (fault.of_messages() != nullptr) {
    apply_to_messages(fault);
    return;
  }
  if (fault.of_network() != nullptr) {
    apply_to_network(fault);
    return;
  }
  if (fault.of_disk() != nullptr) {
    apply_to_disk(fault);
    return;
  }
  const std::string& name = fault.request.process;
  FaultEvent event;
  std::vector<ProcessId> running;
  for (const TrackedProcess* const process : processes_.find(name)) {
    if (process->id != 0 && supervisor_.view(process->id).pid >= 0) {
      running.push_back(process->id);
      event.labels.push_back(supervisor_.view(process->id).label);
    }
  }
  if (running.empty()) {
    miss(fault, fmt::format("'{}' did not run", name));
    return;
  }
  if (const auto* const kill = std::get_if<KillFault>(&fault.request.what)) {
    event.signal = kill->signal;
  }
  log_(fmt::format("fault {}: {}", fault.request.number, describe(fault.request)));
  tell(fault, event);
  for (const ProcessId id : running) {
    const std::string reason = std::visit(
        [&](const auto& what) -> std::string {
          using What = std::decay_t<decltype(what)>;
          if constexpr (std::is_same_v<What, MessageFault> || std::is_same_v<What, NetworkFault> ||
                        std::is_same_v<What, DiskFault>) {
            return {};  // not applied to a process
          } else {
            return apply(fault, id, what);
          }
        },
        fault.request.what);
    if (!reason.empty()) {
      miss(fault, reason);
      return;
    }
    fault.processes.push_back(id);
  }
  if (std::holds_alternative<SlowFault>(fault.request.what)) {
    turn(fault, false);
  }
  if (fault.request.lasts) {
    fault.timer = loop_.after(*fault.request.lasts, [this, &fault] { end(fault); });
  } else {
    fault.is_over = true;
    tell(fault, {.kind = FaultEvent::Kind::kOver});
  }
}

std::string Faults::apply(Fault& /*fault*/, ProcessId id, const KillFault& kill) {
  supervisor_.signal(id, kill.signal);
  return {};
}

std::string Faults::apply(Fault& fault, ProcessId id, const StopFault& /*stop*/) {
  hold(fault, id);
  return {};
}

std::string Faults::apply(Fault& /*fault*/, ProcessId /*id*/, const SlowFault& /*slow*/) {
  return {};  // turn() follows
}

std::string Faults::apply(Fault& fault, ProcessId id, const LimitFault& limit) {
  const std::pair<int, std::optional<std::uint64_t>> limits[] = {{RLIMIT_AS, limit.memory},
                                                                 {RLIMIT_NOFILE, limit.files}};
  for (const auto& [resource, value] : limits) {
    if (!value) {
      continue;
    }
    const std::optional<std::uint64_t> before = supervisor_.limit(id, resource, *value);
    if (!before) {
      return fmt::format("'{}' can't be limited", fault.request.process);
    }
    fault.limits.push_back({id, resource, *before});
  }
  return {};
}

std::string Faults::apply(Fault& fault, ProcessId id, const ClockFault& clock) {
  if (!is_clock(supervisor_.view(id).spec)) {
    return fmt::format("'{}' is no clock", fault.request.process);
  }
  const std::string command = clock.kind == ClockFault::Kind::kSkew   ? fmt::format("scale {}\n", clock.rate)
                              : clock.kind == ClockFault::Kind::kJump ? fmt::format("jump {}\n", clock.by)
                                                                      : "stop\n";
  return supervisor_.write(id, command) ? "" : fmt::format("'{}' does not obey", fault.request.process);
}

// The clock, after a fault that lasts for a time.
void Faults::go_on(const Fault& fault) const {
  const auto* const clock = std::get_if<ClockFault>(&fault.request.what);
  if (clock == nullptr || clock->kind == ClockFault::Kind::kJump) {
    return;
  }
  for (const ProcessId id : fault.processes) {
    supervisor_.write(id, clock->kind == ClockFault::Kind::kStop ? "go\n" : fmt::format("scale {}\n", 1 / clock->rate));
  }
}

void Faults::apply_to_messages(Fault& fault) {
  messages_.arm(fault.request.number, true);
  if (fault.request.lasts) {
    fault.timer = loop_.after(*fault.request.lasts, [this, &fault] { end_messages(fault, " in that time"); });
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
    log_(fmt::format("fault {}: {}", fault.request.number, describe(fault.request)));
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

void Faults::apply_to_network(Fault& fault) {
  if (network_ == nullptr) {
    miss(fault, "there is no network for it");
    return;
  }
  log_(fmt::format("fault {}: {}", fault.request.number, describe(fault.request)));
  fault.impairment = network_->begin(*fault.of_network());
  tell(fault, {});
  if (fault.request.lasts) {
    fault.timer = loop_.after(*fault.request.lasts, [this, &fault] { end_network(fault); });
  } else {
    tell(fault, {.kind = FaultEvent::Kind::kOver});
  }
}

void Faults::end_network(Fault& fault) {
  if (fault.impairment) {
    network_->end(*fault.impairment);
    tell(fault, {.kind = FaultEvent::Kind::kOver, .packets = network_->packets(*fault.impairment)});
    fault.impairment.reset();
  }
  fault.is_over = true;
}

void Faults::apply_to_disk(Fault& fault) {
  log_(fmt::format("fault {}: {}", fault.request.number, describe(fault.request)));
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
  if (fault.request.lasts) {
    fault.timer = loop_.after(*fault.request.lasts, [this, &fault] { end_disk(fault); });
  } else {
    tell(fault, {.kind = FaultEvent::Kind::kOver});
  }
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

void Faults::turn(Fault& fault, bool runs) {
  const unsigned percent = std::get<SlowFault>(fault.request.what).percent;
  for (const ProcessId id : fault.processes) {
    if (runs) {
      release(fault, id);
    } else {
      hold(fault, id);
    }
  }
  fault.turn_timer =
      loop_.after(kTurn * (runs ? percent : kWhole - percent) / kWhole, [this, &fault, runs] { turn(fault, !runs); });
}

void Faults::hold(const Fault& fault, ProcessId id) {
  if (supervisor_.view(id).pid < 0) {
    return;
  }
  std::set<const Fault*>& holders = held_[id];
  if (holders.empty()) {
    supervisor_.pause(id);
  }
  holders.insert(&fault);
}

void Faults::release(const Fault& fault, ProcessId id) {
  const auto held = held_.find(id);
  if (held != held_.end() && held->second.erase(&fault) > 0 && held->second.empty()) {
    held_.erase(held);
    supervisor_.resume(id);
  }
}

void Faults::end(Fault& fault) {
  fault.timer.reset();
  fault.turn_timer.reset();
  for (const ProcessId id : fault.processes) {
    release(fault, id);
  }
  for (const Fault::Limit& limit : fault.limits) {
    supervisor_.limit(limit.id, limit.resource, limit.before);
  }
  fault.limits.clear();
  go_on(fault);
  fault.is_over = true;
  tell(fault, {.kind = FaultEvent::Kind::kOver});
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
    held_.erase(event.id);
    for (Fault& fault : faults_) {
      // The next run has limits of its own.
      std::erase_if(fault.limits, [&](const Fault::Limit& limit) { return limit.id == event.id; });
    }
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
    fault.turn_timer.reset();
    fault.watches.clear();
  }
  for (const auto& [id, holders] : held_) {
    supervisor_.resume(id);
  }
  held_.clear();
}

}  // namespace launch
