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

#include "base/environment/own_environment.hpp"

namespace launch {
namespace {

constexpr std::size_t kReadSize = 64UL * 1024;

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
  listen();
  signal_source_ = loop_.on_signal({SIGINT, SIGTERM, SIGHUP, SIGQUIT}, [this](EventLoop::Signal signal) {
    if (signal.number != SIGHUP || !door_) {  // a connection that hangs up is one that may be made again
      end(1);
    }
  });
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

std::optional<Agent::Return> Agent::take_return() {
  if (return_) {
    return_->out = out_.take();
  }
  return std::exchange(return_, std::nullopt);
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
    lose("it has ended");
    return;
  }
  last_heard_ = Clock::now();
  frames_.add({bytes.data(), static_cast<std::size_t>(count)});
  try {
    while (const std::optional<Frame> frame = in_source_ ? frames_.take() : std::nullopt) {
      if (is_numbered(static_cast<ToAgent>(frame->kind))) {
        received_.count(frame->content.size());
      }
      dispatch(*frame);
    }
    acknowledge(false);
  } catch (const WireError& error) {
    send(FromAgent::kRefused, WireWriter().text(fmt::format("the launcher sends what it must not: {}", error.what())));
    end(1);
  }
}

void Agent::dispatch(const Frame& frame) {
  WireReader reader(frame.content);
  const auto kind = static_cast<ToAgent>(frame.kind);
  if (!questions_ && kind != ToAgent::kSetup && kind != ToAgent::kPing && kind != ToAgent::kSuspend &&
      kind != ToAgent::kEnd && kind != ToAgent::kResume) {
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
      acknowledge(true);
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
    case ToAgent::kResume:
      if (questions_) {
        throw WireError("it comes back, and has not been away");
      }
      parse_resume_request(frame.content);
      return_.emplace(Return{frame.content, std::move(in_), {}});
      end(0);
      return;
    case ToAgent::kAcknowledge: {
      const std::uint64_t count = reader.u64();
      reader.end();
      if (!kept_) {
        throw WireError("it acknowledges what has no number");
      }
      kept_->acknowledge(count);
      return;
    }
  }
  throw WireError("it sends a message of an unknown kind");
}

void Agent::set_up(const AgentSetup& setup) {
  setup_ = setup;
  try {
    if (!setup.id.empty()) {
      door_.emplace(loop_, own_environment(), setup.id, setup.key, [this](UniqueFd connection, std::uint64_t received) {
        come_back(std::move(connection), received);
      });
      guardian_.add_clean_up({"/bin/rm", "-f", "--", door_->path()});
      kept_.emplace();
    }
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

}  // namespace launch
