// SPDX-License-Identifier: Apache-2.0
#include "programs/agent/agent.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

#include "launcher/machines/protocol/spec_wire.hpp"

namespace launch {
namespace {

constexpr std::size_t kReadSize = 64UL * 1024;
// So much may wait for the connection before output is read no further.
constexpr std::size_t kMostWaiting = 1024UL * 1024;

WireWriter pong(std::uint64_t ping) {
  const auto nanoseconds = [](auto now) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now.time_since_epoch()).count();
  };
  const auto epoch = nanoseconds(std::chrono::system_clock::now());
  return WireWriter().u64(ping).i64(epoch).i64(nanoseconds(std::chrono::steady_clock::now()));
}

}  // namespace

Agent::Agent(EventLoop& loop, ProcessRunner& runner, Guardian& guardian, UniqueFd in, UniqueFd out,
             const std::string& launch_version)
    : loop_(loop),
      runner_(runner),
      guardian_(guardian),
      in_(std::move(in)),
      out_(std::move(out)),
      traces_(loop, guardian, [this](FromAgent kind, const WireWriter& content) { send(kind, content); }) {
  ::fcntl(in_.get(), F_SETFL, ::fcntl(in_.get(), F_GETFL) | O_NONBLOCK);
  auto number = std::make_shared<std::int32_t>(0);
  files_.announce_to(
      [this, number](const std::string& path) {
        *number = guardian_.add_clean_up({"/bin/rm", "-rf", "--", path});
      },
      [this, number] { guardian_.remove_clean_up(*number); });
  in_source_ = loop_.on_readable(in_.get(), [this] { receive(); });
  signal_source_ = loop_.on_signal({SIGINT, SIGTERM, SIGHUP, SIGQUIT}, [this](EventLoop::Signal) { end(1); });
  out_.add(agent_greeting(launch_version));
  on_writable();
}

int Agent::run() {
  loop_.run();
  // What is still to be said, such as why the agent refuses.
  for (int tries = 0; tries < 20 && out_.waiting() > 0; ++tries) {
    pollfd writable{out_.fd(), POLLOUT, 0};
    if (::poll(&writable, 1, 50) < 0 || !out_.flush()) {
      break;
    }
  }
  return exit_code_;
}

void Agent::end(int code) {
  exit_code_ = code;
  in_source_.reset();
  for (auto& [number, run] : runs_) {
    run.exit_source.reset();
    run.streams[0].source.reset();
    run.streams[1].source.reset();
  }
  loop_.quit();
}

void Agent::receive() {
  std::array<char, kReadSize> bytes;  // not initialised: it is read into
  const ssize_t count = ::read(in_.get(), bytes.data(), bytes.size());
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
    return;
  }
  if (count <= 0) {
    end(1);
    return;
  }
  last_heard_ = Clock::now();
  frames_.add({bytes.data(), static_cast<std::size_t>(count)});
  try {
    while (const std::optional<Frame> frame = in_source_ ? frames_.take() : std::nullopt) {
      dispatch(*frame);
    }
  } catch (const WireError& error) {
    send(FromAgent::kRefused, WireWriter().text(fmt::format("the launcher sends what it must not: {}", error.what())));
    end(1);
  }
}

void Agent::dispatch(const Frame& frame) {
  WireReader reader(frame.content);
  const auto kind = static_cast<ToAgent>(frame.kind);
  if (!questions_ && kind != ToAgent::kSetup && kind != ToAgent::kPing && kind != ToAgent::kSuspend &&
      kind != ToAgent::kEnd) {
    throw WireError("it has not said how the agent is set up");
  }
  switch (kind) {
    case ToAgent::kSetup:
      if (questions_) {
        throw WireError("it says twice how the agent is set up");
      }
      set_up(parse_agent_setup(frame.content));
      return;
    case ToAgent::kStart:
      start(reader);
      return;
    case ToAgent::kSignal:
      signal(reader);
      return;
    case ToAgent::kCredit:
      take_credit(reader);
      return;
    case ToAgent::kRelease:
      release(reader);
      return;
    case ToAgent::kGroups:
      tell_groups(reader);
      return;
    case ToAgent::kAsk: {
      const std::uint32_t question = reader.u32();
      questions_->answer(reader, [this, question](bool well, const std::string& text) {
        const bool fits = text.size() < kLongestFrame / 2;
        send(FromAgent::kAnswer,
             WireWriter().u32(question).flag(well && fits).text(fits ? text : "the answer is too long"));
      });
      return;
    }
    case ToAgent::kPing:
      send(FromAgent::kPong, pong(reader.u64()));
      return;
    case ToAgent::kSuspend:
      launcher_stopped_ = reader.flag();
      return;
    case ToAgent::kEnd:
      end(0);
      return;
    case ToAgent::kTraceBegin:
    case ToAgent::kTraceEnd:
    case ToAgent::kTraceHurry:
    case ToAgent::kTraceFetch:
    case ToAgent::kTraceLeave:
    case ToAgent::kTraceSnapshot:
      traces_.receive(kind, reader);
      return;
  }
  throw WireError("it sends a message of an unknown kind");
}

void Agent::set_up(const AgentSetup& setup) {
  try {
    const Environment environment = environment_after(setup.setup);
    questions_.emplace(loop_, environment);
    traces_.use_environment(environment);
    send(FromAgent::kHello, WireWriter().rest(to_wire(describe_machine(environment))));
  } catch (const std::exception& error) {
    send(FromAgent::kRefused, WireWriter().text(error.what()));
    end(1);
    return;
  }
  silence_ = std::chrono::milliseconds(setup.silence_milliseconds);
  if (silence_ > Duration{0}) {
    last_heard_ = Clock::now();
    watch_silence();
  }
}

void Agent::watch_silence() {
  silence_timer_ = loop_.after(silence_ / 8, [this] {
    pollfd readable{in_.get(), POLLIN, 0};
    if (launcher_stopped_ || ::poll(&readable, 1, 0) == 1) {
      last_heard_ = Clock::now();
    }
    if (Clock::now() - last_heard_ > silence_) {
      fmt::print(stderr, "launch agent: nothing has come from the launcher for {} s: ending what runs here\n",
                 std::chrono::duration<double>(silence_).count());
      end(1);
    } else {
      watch_silence();
    }
  });
}

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

// Passes on what the process has written, as far as there is credit for it.
void Agent::pump(std::uint32_t number, std::size_t which) {
  Run& run = runs_.at(number);
  Stream& stream = run.streams[which];
  std::array<char, kReadSize> bytes;  // not initialised: clearing it for each line would take noticeable time
  std::size_t total = 0;
  // One process must not keep the loop from the others.
  while (stream.fd && stream.credit > 0 && !stalled_ && total < kReadSize) {
    const std::size_t most = std::min<std::size_t>(bytes.size(), stream.credit);
    const ssize_t size = ::read(stream.fd.get(), bytes.data(), most);
    if (size > 0) {
      stream.credit -= static_cast<std::uint32_t>(size);
      total += static_cast<std::size_t>(size);
      send(FromAgent::kOutput, WireWriter()
                                   .u32(number)
                                   .u8(static_cast<std::uint8_t>(which))
                                   .rest({bytes.data(), static_cast<std::size_t>(size)}));
    } else if (size < 0 && errno == EAGAIN) {
      stream.drained = run.exit.has_value();
      break;
    } else if (size == 0 || errno != EINTR) {
      stream.source.reset();
      stream.fd.reset();
      send(FromAgent::kClosed, WireWriter().u32(number).u8(static_cast<std::uint8_t>(which)));
    }
  }
  if (!stream.fd) {
    stream.drained = true;
    stream.source.reset();
  } else if (stream.credit == 0 || stalled_) {
    stream.source.reset();
  } else if (!stream.source) {
    stream.source = loop_.on_readable(stream.fd.get(), [this, number, which] { pump(number, which); });
  }
  tell_exit(number, run);
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
  if (!run.exit || run.exit_told || !run.streams[0].drained || !run.streams[1].drained) {
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

void Agent::send(FromAgent kind, const WireWriter& content) {
  if (out_.add(encode(kind, content))) {
    on_writable();
  }  // else the end of the launcher comes as the end of the other direction
}

void Agent::on_writable() {
  const std::size_t waiting = out_.waiting();
  if (waiting == 0) {
    out_source_.reset();
  } else if (!out_source_) {
    out_source_ = loop_.on_writable(out_.fd(), [this] {
      if (!out_.flush()) {
        out_source_.reset();
        end(1);
        return;
      }
      on_writable();
    });
  }
  if (waiting > kMostWaiting) {
    stalled_ = true;
  } else if (stalled_ && waiting < kMostWaiting / 2) {
    stalled_ = false;
    // In a later turn: this may be called by the one who reads.
    loop_.post([this] {
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
    });
  }
}

}  // namespace launch
