// SPDX-License-Identifier: Apache-2.0
#include "actions/trace/machines_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "base/text/names.hpp"
#include "launcher/traced/machine_trace.hpp"
#include "launcher/traced/traced_processes.hpp"
#include "tracing/model/chains/chain_definition.hpp"
#include "tracing/record/session/free_name.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

// The folder of this machine.
constexpr const char* kFolderHere = kLocalMachine;
}  // namespace

MachinesTrace::MachinesTrace(TraceRequest request, std::unique_ptr<TraceScope> here, MachineRecorders* recorders,
                             Settings settings, SourceRange origin)
    : request_(std::move(request)),
      here_(std::move(here)),
      recorders_(recorders),
      settings_(std::move(settings)),
      origin_(std::move(origin)) {
  if (!here_) {
    block_snapshot_signal(request_.choices);
  }
}

MachinesTrace::~MachinesTrace() {
  if (worker_.joinable()) {
    worker_.join();
  }
}

std::vector<std::string> MachinesTrace::clean_up_command() {
  if (here_) {
    return here_->clean_up_command();
  }
  name_ = tracing::claim_free_name(request_.config);
  return {};
}

void MachinesTrace::expect(const std::vector<ProcessSpec>& processes) {
  std::set<std::string> machines;
  if (recorders_ == nullptr) {
    // Only planned: nobody connects.
  } else if (settings_.only) {
    machines.insert(*settings_.only);
  } else {
    const std::vector<std::string> connected = recorders_->connected();
    machines.insert(connected.begin(), connected.end());
  }
  for (const std::string& machine : machines) {
    add_part(machine, processes);
  }
  if (parts_.empty()) {
    if (here_) {
      here_->expect(processes);
    }
    return;
  }
  warnings_ = unknown_nodes(request_.choices, processes);
  if (here_) {
    std::vector<ProcessSpec> of_here;
    std::copy_if(processes.begin(), processes.end(), std::back_inserter(of_here),
                 [](const ProcessSpec& spec) { return spec.machine.empty(); });
    session_ = session();
    here_->config().part = kFolderHere;
    if (takes_snapshots()) {
      // From any thread. Before all have begun, there is nobody to ask.
      here_->leave_snapshots_to([this](const std::string& reason, const std::string&) {
        if (loop_ != nullptr) {
          loop_->post([this, reason] { want_by_event(reason); });
        }
      });
    }
    here_->expect_some(of_here);
  }
}

void MachinesTrace::add_part(const std::string& machine, const std::vector<ProcessSpec>& processes) {
  auto part = std::make_unique<Part>();
  part->recorder = recorders_->recorder(machine);
  if (!part->recorder) {
    return;
  }
  MachineTrace trace;
  trace.config = request_.config;
  trace.config.session_name = session() + "-" + machine;
  trace.choices = request_.choices;
  std::copy_if(processes.begin(), processes.end(), std::back_inserter(trace.processes),
               [&](const ProcessSpec& spec) { return spec.machine == machine; });
  part->request = to_wire(trace);
  part->result.machine = machine;
  parts_.push_back(std::move(part));
}

void MachinesTrace::wait_for(std::size_t count, std::function<void()> next) {
  pending_ = count;
  next_ = std::move(next);
  if (count == 0) {
    loop_->post(std::exchange(next_, nullptr));
  }
}

void MachinesTrace::finished_one() {
  if (--pending_ == 0) {
    std::exchange(next_, nullptr)();
  }
}

void MachinesTrace::note(const std::exception_ptr& error) {
  if (!error_) {
    error_ = error;
  }
}

void MachinesTrace::begin(EventLoop& loop, Tell tell, Completion done) {
  loop_ = &loop;
  tell_ = std::move(tell);
  if (parts_.empty() && here_) {
    here_->begin(loop, tell_, std::move(done));
    return;
  }
  done_ = std::move(done);
  std::error_code unknown;
  if (parts_.empty() || fs::exists(directory(), unknown)) {
    const LaunchError error =
        parts_.empty()
            ? LaunchError(fmt::format("there is no connection to machine '{}'", settings_.only.value_or("")), origin_)
            : LaunchError(fmt::format("tracing setup failed: the trace directory '{}' exists already", directory()),
                          origin_, "choose another session-name, or use append-timestamp=\"true\"");
    loop.post([done = std::move(done_), error] { done(std::make_exception_ptr(error)); });
    return;
  }
  for (const std::string& warning : warnings_) {
    tell_(true, warning);
  }
  wait_for(parts_.size() + (here_ ? 1 : 0), [this] { on_begun(); });
  if (here_) {
    here_->begin(loop, tell_, [this](const std::exception_ptr& error) {
      here_begun_ = !error;
      note(error);
      finished_one();
    });
  }
  for (const auto& part : parts_) {
    const std::string machine = part->result.machine;
    part->recorder->begin(
        part->request,
        [this, machine](const std::string& text) { tell_(true, fmt::format("machine '{}': {}", machine, text)); },
        [this, machine](const MachineRecorder::Reason& reason) { want_of(machine, reason); },
        [this, &part = *part](const MachineRecorder::Outcome& outcome) {
          part.begun = outcome.well;
          part.there = outcome.directory;
          if (!outcome.well) {
            note(std::make_exception_ptr(
                LaunchError(fmt::format("tracing setup failed on machine '{}': {}", part.result.machine, outcome.error),
                            origin_, outcome.help)));
          }
          finished_one();
        });
  }
}

void MachinesTrace::on_begun() {
  if (!error_) {
    write_what_is_known();
  }
  if (error_) {
    undo();
    return;
  }
  if (takes_snapshots()) {
    begin_snapshots();
  }
  std::vector<std::string> machines;
  for (const auto& part : parts_) {
    machines.push_back(part->result.machine);
  }
  tell_(false, fmt::format("recording on machine{} {}", machines.size() == 1 ? "" : "s", list_some(machines)));
  std::exchange(done_, nullptr)(nullptr);
}

// What others have begun is no trace of anything.
void MachinesTrace::undo() {
  const auto begun = static_cast<std::size_t>(
      std::count_if(parts_.begin(), parts_.end(), [](const auto& part) { return part->begun; }));
  wait_for(begun + (here_begun_ ? 1 : 0), [this] {
    std::error_code failed;
    fs::remove_all(directory(), failed);
    std::exchange(done_, nullptr)(error_);
  });
  if (here_begun_) {
    here_->hurry();
    here_->end(
        *loop_, [](bool, const std::string&) {}, [this](const std::exception_ptr&) { finished_one(); });
  }
  for (const auto& part : parts_) {
    if (part->begun) {
      part->recorder->end(true, [this, &part = *part](const MachineRecorder::Outcome&) {
        part.recorder->leave(true);
        finished_one();
      });
    }
  }
}

void MachinesTrace::write_what_is_known() {
  std::vector<tracing::MachinePart> all = results();
  for (tracing::MachinePart& part : all) {
    if (part.machine != kLocalMachine) {
      const auto of_machine = std::find_if(parts_.begin(), parts_.end(),
                                           [&](const auto& each) { return each->result.machine == part.machine; });
      part.problem = fmt::format("the launch has not ended the recording of machine '{}', which is in '{}' there",
                                 part.machine, (*of_machine)->there);
    }
  }
  try {
    if (!takes_snapshots()) {  // each of which has a verdict of its own
      tracing::write_machines_verdict(directory(), session(), all);
    }
    if ((!here_ || takes_snapshots()) && !request_.choices.chains.empty()) {
      tracing::write_chains(request_.choices.chains, directory());
    }
  } catch (const std::exception& error) {
    note(std::make_exception_ptr(LaunchError(fmt::format("tracing setup failed: {}", error.what()), origin_)));
  }
}

std::vector<tracing::MachinePart> MachinesTrace::results() const {
  std::vector<tracing::MachinePart> all;
  if (here_) {
    all.push_back({.machine = kLocalMachine, .folder = kFolderHere});
  }
  for (const auto& part : parts_) {
    all.push_back(part->result);
  }
  for (tracing::MachinePart& part : unrecorded()) {
    all.push_back(std::move(part));
  }
  return all;
}

std::vector<tracing::MachinePart> MachinesTrace::unrecorded() const {
  std::vector<tracing::MachinePart> all;
  for (const auto& [machine, processes] : too_late_) {
    all.push_back(
        {.machine = machine,
         .problem = fmt::format("machine '{}' was first used when the trace had begun, so these processes are "
                                "not recorded: {}",
                                machine, list_some(processes))});
  }
  return all;
}

void MachinesTrace::hurry() {
  hurried_ = true;
  if (snapshots_) {
    snapshots_->hurry();
  }
  if (here_) {
    here_->hurry();
  }
  for (const auto& part : parts_) {
    part->recorder->hurry();
  }
}

bool MachinesTrace::is_to_be_recorded(const ProcessSpec& spec) const {
  const auto& patterns = request_.choices.nodes;
  return spec.traced && (!patterns || unknown_nodes(request_.choices, {spec}).size() < patterns->size());
}

void MachinesTrace::prepare(ProcessSpec& spec) const {
  if (is_to_be_recorded(spec)) {
    used_.insert(spec.machine.empty() ? kLocalMachine : spec.machine);
  }
  if (spec.machine.empty()) {
    if (here_) {
      here_->prepare(spec);
    }
    return;
  }
  const bool is_recorded =
      std::any_of(parts_.begin(), parts_.end(), [&](const auto& part) { return part->result.machine == spec.machine; });
  if (is_recorded || settings_.only || !is_to_be_recorded(spec)) {
    return;
  }
  std::vector<std::string>& processes = too_late_[spec.machine];
  if (processes.empty() && tell_) {
    tell_(true, fmt::format("machine '{}' was not in use when the trace began: its processes are not recorded",
                            spec.machine));
  }
  if (std::find(processes.begin(), processes.end(), spec.name) == processes.end()) {
    processes.push_back(spec.name);
  }
}

}  // namespace launch
