// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/machine_connections.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/machines/connected_machine.hpp"
#include "launcher/substitution/template_parser.hpp"

namespace launch {

struct MachineConnections::Machine {
  MachineConnection connection;
  std::shared_ptr<MachineView> view{};
};

MachineConnections::MachineConnections(EventLoop& loop, std::string launch_version, MachineConnection::Tell tell)
    : loop_(loop), launch_version_(std::move(launch_version)), tell_(std::move(tell)) {}

MachineConnections::~MachineConnections() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake_.notify_all();
  if (pings_.joinable()) {
    pings_.join();
  }
  // All at once, before each is waited for.
  for (const auto& [name, machine] : machines_) {
    machine->connection.send(ToAgent::kEnd);
  }
}

void MachineConnections::connect(const MachineDeclaration& machine) {
  const std::lock_guard lock(mutex_);
  if (machines_.contains(machine.name)) {
    return;
  }
  std::vector<std::string> words = split_shell_words(machine.connect, machine.connect_where);
  words.insert(words.end(), {machine.launch, "agent"});
  machines_.emplace(machine.name, std::unique_ptr<Machine>(new Machine{{loop_,
                                                                        {.name = machine.name,
                                                                         .connect = machine.connect,
                                                                         .words = std::move(words),
                                                                         .setup = machine.setup,
                                                                         .keepalive = machine.keepalive,
                                                                         .connect_timeout = machine.connect_timeout,
                                                                         .grace = machine.grace,
                                                                         .keep = machine.keep,
                                                                         .keep_for = machine.keep_for,
                                                                         .launch_version = launch_version_},
                                                                        tell_}}));
  machines_.at(machine.name)->connection.observe_loss([this](const LostMachine& lost) {
    if (observe_losses_) {
      observe_losses_(lost);
    }
  });
  machines_.at(machine.name)->connection.observe_return([this](const ReturnedMachine& returned) {
    if (observe_returns_) {
      observe_returns_(returned);
    }
  });
  const Duration between = machine.keepalive / 4;
  between_pings_ = between_pings_ == Duration{0} ? between : std::min(between_pings_, between);
  if (!pings_.joinable()) {
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &before);  // signals are for the loop
    pings_ = std::thread([this] { ping_all(); });
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  } else {
    wake_.notify_all();
  }
}

void MachineConnections::ping_all() {
  std::unique_lock lock(mutex_);
  while (!ends_) {
    wake_.wait_for(lock, between_pings_);
    for (const auto& [name, machine] : machines_) {
      machine->connection.ping();
    }
  }
}

std::shared_ptr<MachineView> MachineConnections::await(const MachineDeclaration& machine) {
  connect(machine);
  Machine& there = *machines_.at(machine.name);
  const SourceRange& where = machine.connect_where ? machine.connect_where : machine.where;
  try {
    const AgentHello& hello = there.connection.await_hello();
    if (there.connection.is_lost()) {
      throw LaunchError(there.connection.why_lost(), where, {}, Finding::kNone);
    }
    if (there.view == nullptr) {
      there.view = make_connected_machine(there.connection, hello);
    }
    return there.view;
  } catch (const MachineError& error) {
    throw LaunchError(error.what(), where, error.help);
  }
}

std::vector<std::string> MachineConnections::connected() const {
  std::vector<std::string> names;
  for (const auto& [name, machine] : machines_) {
    if (machine->view != nullptr && !machine->connection.is_lost()) {
      names.push_back(name);
    }
  }
  return names;
}

std::unique_ptr<MachineRecorder> MachineConnections::recorder(const std::string& machine) {
  const auto found = machines_.find(machine);
  return found == machines_.end() ? nullptr : found->second->connection.traces().recorder();
}

RemoteRuns* MachineConnections::runs(const std::string& machine) {
  const auto found = machines_.find(machine);
  return found == machines_.end() ? nullptr : &found->second->connection.runs();
}

bool MachineConnections::is_away(const std::string& machine) const {
  const auto found = machines_.find(machine);
  return found != machines_.end() && found->second->connection.is_away();
}

void MachineConnections::expect_end() {
  for (const auto& [name, machine] : machines_) {
    machine->connection.expect_end();
  }
}

void MachineConnections::suspend(bool stops) {
  for (const auto& [name, machine] : machines_) {
    machine->connection.suspend(stops);
  }
}

}  // namespace launch
