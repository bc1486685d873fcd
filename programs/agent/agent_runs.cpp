// SPDX-License-Identifier: Apache-2.0
// The processes of an agent, and what they write.
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

#include "launcher/machines/protocol/spec_wire.hpp"
#include "programs/agent/agent.hpp"

namespace launch {
namespace {

constexpr std::size_t kOutputPiece = 64UL * 1024;

}  // namespace

void Agent::start(WireReader& reader) {
  const std::uint32_t number = reader.u32();
  ProcessSpec spec = get_spec(reader);
  if (number <= last_run_) {
    throw WireError("the number of a start has been used");
  }
  last_run_ = number;
  Run run;
  try {
    files_.write(spec, number);
    traces_.prepare(spec);
    spec.mark = guardian_.mark(spec.label, spec);
    run.process = runner_.spawn(spec);
  } catch (const std::system_error& error) {
    send(FromAgent::kFailed, WireWriter().u32(number).i32(error.code().value()).text(error.what()));
    return;
  }
  guardian_.note(number, run.process.pid, spec.label, spec);
  run.started = loop_.now();
  run.label = spec.label.empty() ? spec.name : spec.label;
  traces_.started(run.process.pid);
  run.streams[0].fd = std::move(run.process.out);
  run.streams[1].fd = std::move(run.process.err);
  send(FromAgent::kStarted, WireWriter().u32(number).i32(run.process.pid));
  Run& kept = runs_.emplace(number, std::move(run)).first->second;
  kept.exit_source = loop_.on_exit(kept.process.pidfd.get(), [this, number] { on_exit(number); });
  for (std::size_t which = 0; which < kept.streams.size(); ++which) {
    pump(number, which);
  }
}

// Passes on what the process has written, as far as there is credit for it. While nobody can take it, it is spooled.
void Agent::pump(std::uint32_t number, std::size_t which) {
  Run& run = runs_.at(number);
  Stream& stream = run.streams[which];
  const auto may_send = [&] { return !away_ && !stalled_ && stream.credit > 0; };
  while (!stream.spool.empty() && may_send()) {
    send_output(number, which, stream.spool.take(std::min<std::size_t>(kOutputPiece, stream.credit), spooled_));
  }
  std::array<char, kOutputPiece> bytes;  // not initialised: clearing it for each line would take noticeable time
  std::size_t total = 0;
  // One process must not keep the loop from the others.
  while (stream.fd && (away_ || (may_send() && stream.spool.empty())) && total < kOutputPiece) {
    const std::size_t most = away_ ? bytes.size() : std::min<std::size_t>(bytes.size(), stream.credit);
    const ssize_t size = ::read(stream.fd.get(), bytes.data(), most);
    if (size > 0) {
      total += static_cast<std::size_t>(size);
      const std::string_view read(bytes.data(), static_cast<std::size_t>(size));
      if (!away_ && stream.spool.is_idle()) {
        stream.spool.pass(read);
        send_output(number, which, read);
        continue;
      }
      stream.spool.add(read, spooled_);
      if (!away_ && !stream.spool.empty()) {  // behind the rest of a line that was dropped
        send_output(number, which, stream.spool.take(most, spooled_));
      }
    } else if (size < 0 && errno == EAGAIN) {
      stream.drained = run.exit.has_value();
      break;
    } else if (size == 0 || errno != EINTR) {
      stream.source.reset();
      stream.fd.reset();
    }
  }
  if (!stream.fd) {
    stream.drained = true;
    stream.source.reset();
    if (stream.spool.empty() && !stream.closed) {
      stream.closed = true;
      send(FromAgent::kClosed, WireWriter().u32(number).u8(static_cast<std::uint8_t>(which)));
    }
  } else if (!away_ && (!may_send() || !stream.spool.empty())) {
    stream.source.reset();
  } else if (!stream.source) {
    stream.source = loop_.on_readable(stream.fd.get(), [this, number, which] { pump(number, which); });
  }
  tell_exit(number, run);
}

void Agent::send_output(std::uint32_t number, std::size_t which, std::string_view bytes) {
  runs_.at(number).streams[which].credit -= static_cast<std::uint32_t>(bytes.size());
  send(FromAgent::kOutput, WireWriter().u32(number).u8(static_cast<std::uint8_t>(which)).rest(bytes));
}

void Agent::pump_all() {
  std::vector<std::uint32_t> numbers;
  for (const auto& [number, run] : runs_) {
    numbers.push_back(number);
  }
  for (const std::uint32_t number : numbers) {
    if (runs_.contains(number)) {
      pump(number, 0);
      pump(number, 1);
    }
  }
}

void Agent::on_exit(std::uint32_t number) {
  Run& run = runs_.at(number);
  run.exit_source.reset();
  ProcessExit exit = runner_.outcome(run.process);
  if (exit.code == -SIGKILL && !run.signalled) {
    exit.out_of_memory = runner_.was_ended_by_kernel(run.process, run.started);
  }
  run.exit = exit;
  traces_.ended(run.label, run.process.pid, exit.code, run.signalled);
  // What it has written before comes first.
  for (std::size_t which = 0; which < run.streams.size(); ++which) {
    pump(number, which);
  }
}

void Agent::tell_exit(std::uint32_t number, Run& run) {
  const auto is_passed_on = [](const Stream& stream) { return stream.drained && stream.spool.empty(); };
  if (!run.exit || run.exit_told || !is_passed_on(run.streams[0]) || !is_passed_on(run.streams[1])) {
    return;
  }
  run.exit_told = true;
  WireWriter content;
  content.u32(number);
  put(content, *run.exit);
  send(FromAgent::kExited, content);
}

void Agent::signal(WireReader& reader) {
  constexpr int kLastSignal = 64;
  const std::uint32_t number = reader.u32();
  const int signal = reader.i32();
  reader.end();
  if (signal < 1 || signal > kLastSignal) {
    throw WireError("a signal has a number that is none");
  }
  if (const auto found = runs_.find(number); found != runs_.end()) {
    found->second.signalled = true;
    runner_.signal_group(found->second.process, signal);
  }
}

void Agent::take_credit(WireReader& reader) {
  const std::uint32_t number = reader.u32();
  const std::uint8_t which = reader.u8();
  const std::uint32_t bytes = reader.u32();
  reader.end();
  const auto found = runs_.find(number);
  if (which > 1 || bytes > kStreamWindow) {
    throw WireError("a credit is for no stream, or too high");
  }
  if (found == runs_.end()) {
    return;
  }
  Stream& stream = found->second.streams[which];
  if (stream.credit + bytes > kStreamWindow) {
    throw WireError("a credit is too high");
  }
  stream.credit += bytes;
  pump(number, which);
}

void Agent::release(WireReader& reader) {
  const std::uint32_t number = reader.u32();
  reader.end();
  const auto found = runs_.find(number);
  if (found == runs_.end()) {
    throw WireError("it releases a process that is not there");
  }
  if (!found->second.exit) {
    throw WireError("it releases a process that runs");
  }
  runner_.reap(found->second.process);
  runs_.erase(found);
}

void Agent::tell_groups(WireReader& reader) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t left = reader.count(sizeof(std::uint32_t)); left > 0; --left) {
    numbers.push_back(reader.u32());
  }
  reader.end();
  std::vector<const Process*> leaders;
  std::vector<std::uint32_t> there;
  for (const std::uint32_t number : numbers) {
    if (const auto found = runs_.find(number); found != runs_.end() && found->second.exit) {
      there.push_back(number);
      leaders.push_back(&found->second.process);
    }
  }
  const std::vector<bool> live = leaders.empty() ? std::vector<bool>() : runner_.groups_live(leaders);
  WireWriter answer;
  answer.u32(static_cast<std::uint32_t>(there.size()));
  for (std::size_t i = 0; i < there.size(); ++i) {
    answer.u32(there[i]).flag(live[i]);
  }
  send(FromAgent::kGroups, answer);
}

}  // namespace launch
