// SPDX-License-Identifier: Apache-2.0
#include "programs/agent/agent_traces.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <signal.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/environment/own_prefix.hpp"
#include "launcher/traced/machine_trace.hpp"
#include "launcher/traced/traced_processes.hpp"
#include "programs/agent/trace_files.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/traced_run.hpp"
#include "tracing/record/session/tracer.hpp"

namespace launch {
namespace {

constexpr std::chrono::milliseconds kNodesHaveRegistered{500};  // as a <trace> of this machine

// What the command prints would go to the launcher. When that has gone, a write into the pipe would end the command
// before it has judged the recording.
std::vector<std::string> without_output(const std::vector<std::string>& command) {
  std::vector<std::string> words = {"/bin/sh", "-c", "exec \"$@\" >/dev/null 2>&1", "sh"};
  words.insert(words.end(), command.begin(), command.end());
  return words;
}

// Nothing, if there is no directory, or one without a snapshot, which is removed.
std::string what_is_written(const tracing::TraceConfig& config) {
  const std::string directory = config.trace_directory();
  std::error_code none;
  if (config.records_snapshots()) {
    std::filesystem::remove(directory, none);  // if it is empty
  }
  return std::filesystem::is_directory(directory, none) ? directory : "";
}

}  // namespace

// What can be fetched: a trace that has ended, or a snapshot.
struct AgentTraces::Recording {
  std::uint32_t number = 0;
  std::string directory;
  std::unique_ptr<TraceFiles> files = nullptr;
  bool sending = false;
};

struct AgentTraces::Trace {
  enum class State { kBeginning, kRecording, kEnding, kEnded };

  Trace(std::uint32_t its_number, MachineTrace trace)
      : number(its_number),
        run(std::move(trace.config), tracing::make_lttng_tracer(), own_prefix(), trace.choices),
        processes(run, trace.choices) {}

  std::uint32_t number;
  tracing::TracedRun run;
  TracedProcesses processes;
  State state = State::kBeginning;
  bool ends = false;  // asked for while it begins or while it is looked around
  bool nothing_to_record = false;
  bool busy = false;          // a thread is in the run
  std::size_t snapshots = 0;  // being taken
  std::int32_t clean_up = 0;
  EventLoop::SourcePtr look_around;
};

AgentTraces::AgentTraces(EventLoop& loop, Guardian& guardian, Send send)
    : loop_(loop), guardian_(guardian), send_(std::move(send)) {}

AgentTraces::~AgentTraces() {
  *lives_ = false;
  for (auto& [number, trace] : traces_) {
    trace->look_around.reset();
    // The process is about to end, and a thread may be in it.
    static_cast<void>(new std::shared_ptr<Trace>(std::move(trace)));
  }
}

void AgentTraces::receive(ToAgent kind, WireReader& reader) {
  const std::uint32_t number = reader.u32();
  if (kind == ToAgent::kTraceBegin) {
    begin(number, reader);
    return;
  }
  if (kind == ToAgent::kTraceFetch || kind == ToAgent::kTraceLeave) {
    const auto found = recordings_.find(number);
    if (found == recordings_.end()) {
      throw WireError("it asks for a recording that is not there");
    }
    if (kind == ToAgent::kTraceFetch) {
      const std::uint32_t credit = reader.u32();
      reader.end();
      fetch(found->second, credit);
    } else {
      const bool remove = reader.flag();
      reader.end();
      leave(number, remove);
    }
    return;
  }
  const auto found = traces_.find(number);
  if (found == traces_.end()) {
    throw WireError("it speaks of a trace that is not there");
  }
  const std::shared_ptr<Trace> trace = found->second;
  switch (kind) {
    case ToAgent::kTraceEnd:
      if (trace->ends) {
        throw WireError("it ends a trace twice");
      }
      trace->nothing_to_record = reader.flag();
      reader.end();
      trace->ends = true;
      end(trace);
      return;
    case ToAgent::kTraceHurry:
      reader.end();
      trace->run.hurry();
      return;
    case ToAgent::kTraceSnapshot:
      take_snapshot(trace, reader);
      return;
    default:
      throw WireError("it sends a message of an unknown kind");
  }
}

std::uint32_t AgentTraces::take_number(std::uint32_t number) {
  if (number <= last_) {
    throw WireError("the number of a trace has been used");
  }
  last_ = number;
  return number;
}

void AgentTraces::take_snapshot(const std::shared_ptr<Trace>& trace, WireReader& reader) {
  const std::uint32_t number = take_number(reader.u32());
  tracing::SnapshotOrder order = parse_snapshot_order(reader.rest());
  if (trace->ends || trace->state != Trace::State::kRecording || !trace->run.config().records_snapshots()) {
    throw WireError("it wants a snapshot of a trace that takes none");
  }
  ++trace->snapshots;
  const auto taken = std::make_shared<tracing::TakenSnapshot>();
  in_background([trace, taken, order = std::move(order)] { *taken = trace->run.take_snapshot(order); },
                [this, trace, taken, number](bool, const std::string&, const std::string&) {
                  --trace->snapshots;
                  tell_ended(number, taken->error.empty(), taken->error, "", taken->directory);
                  end(trace);
                });
}

// What is written can be fetched from now on.
void AgentTraces::tell_ended(std::uint32_t number, bool well, const std::string& error, const std::string& remedy,
                             const std::string& directory) {
  recordings_.emplace(number, std::make_shared<Recording>(Recording{.number = number, .directory = directory}));
  send_(FromAgent::kTraceEnded, WireWriter().u32(number).flag(well).text(error).text(remedy).text(directory));
}

void AgentTraces::begin(std::uint32_t number, WireReader& reader) {
  take_number(number);
  MachineTrace what = parse_machine_trace(reader.rest());
  const std::vector<ProcessSpec> processes = std::move(what.processes);
  what.config.base_path = tracing::trace_base_path("", environment_);
  const auto trace = std::make_shared<Trace>(number, std::move(what));
  traces_.emplace(number, trace);
  trace->clean_up = guardian_.add_clean_up(without_output(trace->run.clean_up_command()));
  trace->processes.expect(processes, false);
  if (trace->run.config().records_snapshots()) {
    trace->run.leave_snapshots_to([this, lives = lives_, number](const std::string& reason, const std::string&) {
      loop_.post([this, lives, number, reason] {
        if (*lives) {
          send_(FromAgent::kTraceWish, WireWriter().u32(number).flag(false).text(reason).i32(0));
        }
      });
    });
  }
  trace->busy = true;
  const auto told = [this, lives = lives_, number](bool warning, const std::string& text) {
    if (warning) {  // what else it tells, the launcher tells of all machines together
      loop_.post([this, lives, number, text] {
        if (*lives) {
          send_(FromAgent::kTraceTold, WireWriter().u32(number).text(text));
        }
      });
    }
  };
  in_background(
      [trace, told] {
        if (const std::optional<std::string> refused = trace->processes.refused()) {
          throw tracing::TraceError(*refused, "use tracetools=\"auto\", or trace=\"false\" for the process");
        }
        trace->run.start(told, {});
      },
      [this, trace, told](bool well, const std::string& error, const std::string& remedy) {
        trace->busy = false;
        trace->state = well ? Trace::State::kRecording : Trace::State::kEnded;
        if (!well) {
          guardian_.remove_clean_up(trace->clean_up);
        }
        send_(FromAgent::kTraceBegun, WireWriter()
                                          .u32(trace->number)
                                          .flag(well)
                                          .text(error)
                                          .text(remedy)
                                          .text(trace->run.config().trace_directory()));
        if (well && !trace->ends && !trace->run.config().events_ust.empty()) {
          trace->look_around = loop_.after(kNodesHaveRegistered, [this, trace, told] {
            trace->busy = true;
            in_background([trace, told] { trace->run.look_around(told); },
                          [this, trace](bool, const std::string&, const std::string&) {
                            trace->busy = false;
                            end(trace);
                          });
          });
        }
        end(trace);
      });
}

// When it was asked for, and nothing else is at work.
void AgentTraces::end(const std::shared_ptr<Trace>& trace) {
  if (!trace->ends || trace->busy || trace->snapshots > 0 || trace->state != Trace::State::kRecording) {
    return;
  }
  trace->look_around.reset();
  trace->state = Trace::State::kEnding;
  trace->busy = true;
  trace->run.config().tracetools = trace->processes.uses();
  trace->run.config().nothing_to_record = trace->nothing_to_record;
  const auto told = [this, lives = lives_, number = trace->number](bool warning, const std::string& text) {
    if (warning) {
      loop_.post([this, lives, number, text] {
        if (*lives) {
          send_(FromAgent::kTraceTold, WireWriter().u32(number).text(text));
        }
      });
    }
  };
  in_background([trace, told] { trace->run.finish(told); },
                [this, trace](bool well, const std::string& error, const std::string& remedy) {
                  trace->busy = false;
                  trace->state = Trace::State::kEnded;
                  guardian_.remove_clean_up(trace->clean_up);
                  tell_ended(trace->number, well, error, remedy, what_is_written(trace->run.config()));
                });
}

void AgentTraces::fetch(const std::shared_ptr<Recording>& recording, std::uint32_t credit) {
  if (credit > kTraceWindow || (recording->files && recording->files->credit() + credit > kTraceWindow)) {
    throw WireError("a credit is too high");
  }
  try {
    if (!recording->files) {
      recording->files = std::make_unique<TraceFiles>(recording->number, recording->directory);
    }
  } catch (const std::exception& error) {
    send_(FromAgent::kTraceFailed, WireWriter().u32(recording->number).text(error.what()));
    return;
  }
  recording->files->add_credit(credit);
  if (!recording->sending) {
    send_files(recording);
  }
}

// A piece in each turn of the loop, so that output and exits go on meanwhile.
void AgentTraces::send_files(const std::shared_ptr<Recording>& recording) {
  try {
    recording->sending = recording->files->send_some(send_);
  } catch (const std::exception& error) {
    recording->sending = false;
    send_(FromAgent::kTraceFailed, WireWriter().u32(recording->number).text(error.what()));
    return;
  }
  if (recording->sending) {
    loop_.post([this, lives = lives_, recording] {
      if (*lives) {
        send_files(recording);
      }
    });
  }
}

void AgentTraces::leave(std::uint32_t number, bool remove) {
  const std::string directory = recordings_.at(number)->directory;
  recordings_.erase(number);
  traces_.erase(number);
  if (remove && !directory.empty()) {
    std::error_code failed;
    std::filesystem::remove_all(directory, failed);
    if (failed) {
      fmt::print(stderr, "launch agent: cannot remove '{}': {}\n", directory, failed.message());
    }
  }
}

void AgentTraces::in_background(std::function<void()> work,
                                std::function<void(bool well, std::string, std::string)> finished) {
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  std::thread([this, lives = lives_, work = std::move(work), finished = std::move(finished)] {
    bool well = true;
    std::string error;
    std::string remedy;
    try {
      work();
    } catch (const tracing::TraceError& failure) {
      well = false;
      error = failure.what();
      remedy = failure.remedy();
    } catch (const std::exception& failure) {
      well = false;
      error = failure.what();
    }
    loop_.post([lives, finished, well, error, remedy] {
      if (*lives) {
        finished(well, error, remedy);
      }
    });
  }).detach();
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void AgentTraces::prepare(ProcessSpec& spec) {
  for (const auto& [number, trace] : traces_) {
    if (trace->state == Trace::State::kRecording && !trace->ends) {
      trace->processes.prepare(spec, [this, number = number](const std::string& warning) {
        send_(FromAgent::kTraceTold, WireWriter().u32(number).text(warning));
      });
    }
  }
}

void AgentTraces::started(pid_t pid) {
  for (const auto& [number, trace] : traces_) {
    trace->run.process_started(pid);
  }
}

void AgentTraces::ended(const std::string& name, pid_t pid, std::int32_t code, bool asked_for) {
  for (const auto& [number, trace] : traces_) {
    trace->run.process_ended(name, pid, code != 0);
    if (trace->run.choices().snapshot_on_crash && code != 0 && !asked_for && trace->state == Trace::State::kRecording) {
      send_(FromAgent::kTraceWish, WireWriter().u32(number).flag(true).text(name).i32(code));
    }
  }
}

}  // namespace launch
