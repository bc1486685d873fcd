// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/machine_connection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "base/processes/spawn.hpp"
#include "base/text/quoted_text.hpp"

namespace launch {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kPatienceAtEnd{30};            // for the guardian there, which ends what processes have left
constexpr milliseconds kPatienceAfterLoss{300};  // for the command to say why
constexpr seconds kLongestAnswer{30};
constexpr std::size_t kLongestBanner = 64 * 1024;
constexpr int kPingsForATrace = 32;  // at its begin and at its end, to compare the clocks
constexpr int kCommandNotFound = 127;
constexpr int kCommandNotExecutable = 126;
constexpr int kNoConnectionOfSsh = 255;

// Signals wait while a launch file is visited. One that asks for the end must not wait for a machine that hangs.
bool is_interrupted() {
  sigset_t waiting;
  return ::sigpending(&waiting) == 0 && (sigismember(&waiting, SIGINT) == 1 || sigismember(&waiting, SIGTERM) == 1 ||
                                         sigismember(&waiting, SIGHUP) == 1 || sigismember(&waiting, SIGQUIT) == 1);
}

}  // namespace

MachineConnection::MachineConnection(EventLoop& loop, Settings settings, Tell tell)
    : loop_(loop),
      settings_(std::move(settings)),
      tell_(std::move(tell)),
      runs_(loop, [this](ToAgent kind, const WireWriter& content) { send(kind, content); }),
      traces_(loop, settings_.name, clock_, [this](ToAgent kind, const WireWriter& content) { send(kind, content); }) {
  try {
    command_ = std::make_unique<ConnectingCommand>(settings_.words);
  } catch (const std::system_error& error) {
    lost_ = fmt::format("no connection to machine '{}': {}", settings_.name, error.what());
    help_ = "connect needs a command, such as 'ssh robot'";
    return;
  }
  outgoing_ = std::make_unique<Outgoing>(command_->take_input());
  output_source_ = loop_.on_readable(command_->output(), [this] { receive(); });
  error_source_ = loop_.on_readable(command_->error(), [this] {
    if (!command_->read_error(hello_ ? teller() : nullptr)) {
      error_source_.reset();
    }
  });
}

MachineConnection::~MachineConnection() {
  output_source_.reset();
  error_source_.reset();
  silence_timer_.reset();
  write_source_.reset();
  if (!command_) {
    return;
  }
  if (!lost_ && greeted_) {
    // The guardian there ends what is left, and the command ends when it has.
    outgoing_->add(encode(ToAgent::kEnd));
    const Clock::time_point end = Clock::now() + kPatienceAtEnd;
    constexpr int kOften = 100;  // milliseconds
    std::array<char, 4096> bytes{};
    bool agent_is_there = true;  // its guardian may still be at work
    while (Clock::now() < end && !command_->ends_by_itself(milliseconds(agent_is_there ? 0 : 20))) {
      std::array<pollfd, 3> waits{{{agent_is_there ? command_->output() : -1, POLLIN, 0},
                                   {command_->error(), POLLIN, 0},
                                   {outgoing_->waiting() > 0 ? outgoing_->fd() : -1, POLLOUT, 0}}};
      ::poll(waits.data(), waits.size(), kOften);
      agent_is_there = agent_is_there && ::read(command_->output(), bytes.data(), bytes.size()) != 0;
      command_->read_error(teller());
      outgoing_->flush();
    }
    command_->read_error(teller());
  }
  outgoing_->close();
  command_->end(greeted_ && !lost_ ? milliseconds(500) : milliseconds(0));
}

std::function<void(std::string_view line)> MachineConnection::teller() const {
  return
      [this](std::string_view line) { tell_(LogLevel::kInfo, fmt::format("machine '{}': {}", settings_.name, line)); };
}

void MachineConnection::send(ToAgent kind, const WireWriter& content) {
  if (lost_ || !outgoing_) {
    return;
  }
  if (!outgoing_->add(encode(kind, content))) {
    return;  // the end of its output comes, too, and tells why
  }
  watch_output();
  if (kind == ToAgent::kTraceBegin || kind == ToAgent::kTraceEnd || kind == ToAgent::kTraceSnapshot) {
    more_pings_ = kPingsForATrace;
    ping();
  }
}

void MachineConnection::take_pong(WireReader& reader) {
  const auto sent = static_cast<std::int64_t>(reader.u64());
  ClockReading there;
  there.epoch_ns = reader.i64();
  there.monotonic_ns = reader.i64();
  reader.end();
  clock_.take_answer(sent, there);
  if (std::exchange(more_pings_, std::max(more_pings_ - 1, 0)) > 0) {
    ping();
  }
}

void MachineConnection::ping() {
  if (!expects_pings_) {
    return;
  }
  const std::chrono::nanoseconds now = Clock::now().time_since_epoch();
  outgoing_->add(encode(ToAgent::kPing, WireWriter().i64(now.count())));
}

void MachineConnection::suspend(bool stops) {
  suspended_ = stops;
  last_heard_ = Clock::now();
  if (hello_) {
    send(ToAgent::kSuspend, WireWriter().flag(stops));
  }
}

void MachineConnection::watch_output() {
  if (outgoing_->waiting() == 0) {
    write_source_.reset();
  } else if (!write_source_) {
    write_source_ = loop_.on_writable(outgoing_->fd(), [this] {
      if (!outgoing_->flush() || outgoing_->waiting() == 0) {
        write_source_.reset();
      }
    });
  }
}

const AgentHello& MachineConnection::await_hello() {
  wait_until([this] { return hello_.has_value(); }, begun_, settings_.connect_timeout, "launch has not answered there");
  return *hello_;
}

std::string MachineConnection::ask(AgentQuestion what, const WireWriter& content) {
  await_hello();
  const std::uint32_t number = ++questions_;
  answers_[number];
  WireWriter question;
  question.u32(number).u8(static_cast<std::uint8_t>(what)).rest(content.bytes());
  send(ToAgent::kAsk, question);
  wait_until([&] { return answers_[number].has_value(); }, Clock::now(), kLongestAnswer, "no answer has come");
  const Answer answer = *answers_[number];
  answers_.erase(number);
  if (!answer.well) {
    throw std::runtime_error(answer.text);
  }
  return answer.text;
}

void MachineConnection::wait_until(const std::function<bool()>& done, Clock::time_point begin, Duration limit,
                                   const std::string& what) {
  const Clock::time_point end = begin + std::chrono::duration_cast<Clock::duration>(limit);
  while (!done()) {
    if (lost_) {
      throw_lost();
    }
    if (is_interrupted()) {
      throw MachineError(fmt::format("interrupted while waiting for machine '{}'", settings_.name), "");
    }
    const auto left = std::chrono::duration_cast<milliseconds>(end - Clock::now());
    if (left <= milliseconds(0)) {
      lose(fmt::format("{} for {} s", what, std::chrono::duration<double>(limit).count()),
           fmt::format("see whether '{} true' works; connect_timeout allows more time", settings_.connect));
      continue;
    }
    std::array<pollfd, 3> waits{{{command_->output(), POLLIN, 0},
                                 {command_->error(), POLLIN, 0},
                                 {outgoing_->waiting() > 0 ? outgoing_->fd() : -1, POLLOUT, 0}}};
    constexpr milliseconds kBetweenLooksAtSignals{100};
    if (::poll(waits.data(), waits.size(), static_cast<int>(std::min(left, kBetweenLooksAtSignals).count())) < 0) {
      continue;
    }
    if (waits[1].revents != 0) {
      command_->read_error({});
    }
    if (waits[2].revents != 0) {
      outgoing_->flush();
    }
    if (waits[0].revents != 0) {
      receive();
    }
  }
}

void MachineConnection::receive() {
  std::array<char, 64UL * 1024> bytes;  // not initialised: it is read into
  const ssize_t count = ::read(command_->output(), bytes.data(), bytes.size());
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
    return;
  }
  if (count <= 0) {
    lose("");
    return;
  }
  last_heard_ = Clock::now();
  const std::string_view text(bytes.data(), static_cast<std::size_t>(count));
  if (greeted_) {
    frames_.add(text);
  } else {
    before_greeting_ += text;
    take_greeting();
  }
  try {
    while (!lost_ && greeted_) {
      const std::optional<Frame> frame = frames_.take();
      if (!frame) {
        break;
      }
      dispatch(*frame);
    }
  } catch (const WireError& error) {
    lose(fmt::format("the agent there sends what it must not: {}", error.what()));
  }
}

// Passes over what a login prints.
void MachineConnection::take_greeting() {
  std::size_t begin = 0;
  for (std::size_t end; (end = before_greeting_.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const auto version = parse_agent_greeting(std::string_view(before_greeting_).substr(begin, end - begin));
    if (!version) {
      continue;
    }
    if (version->protocol != kAgentProtocol) {
      lose(fmt::format("launch {} there and {} here can't talk with each other",
                       without_control_characters(version->launch_version), settings_.launch_version),
           "install the same version on both machines");
      return;
    }
    greeted_ = true;
    frames_.add(std::string_view(before_greeting_).substr(end + 1));
    before_greeting_.clear();
    if (version->launch_version != settings_.launch_version) {
      tell_(LogLevel::kWarning,
            fmt::format("launch has version {} on machine '{}', and {} here",
                        without_control_characters(version->launch_version), settings_.name, settings_.launch_version));
    }
    AgentSetup setup;
    setup.setup = settings_.setup;
    setup.name = settings_.name;
    // This side tells its user first that the connection is lost.
    setup.silence_milliseconds =
        static_cast<std::uint32_t>(2 * std::chrono::duration_cast<milliseconds>(settings_.keepalive).count());
    send(ToAgent::kSetup, WireWriter().rest(to_wire(setup)));
    return;
  }
  if (before_greeting_.size() > kLongestBanner) {
    before_greeting_.erase(0, before_greeting_.size() - kLongestBanner / 2);
  }
}

void MachineConnection::dispatch(const Frame& frame) {
  WireReader reader(frame.content);
  const auto kind = static_cast<FromAgent>(frame.kind);
  switch (kind) {
    case FromAgent::kHello:
      if (hello_) {
        throw WireError("it tells of its machine twice");
      }
      hello_ = parse_agent_hello(frame.content);
      expects_pings_ = true;
      tell_(LogLevel::kInfo, fmt::format("machine '{}' is {} ({}), with {} packages", settings_.name,
                                         without_control_characters(hello_->host),
                                         without_control_characters(hello_->architecture), hello_->packages.size()));
      watch_silence();
      return;
    case FromAgent::kRefused: {
      const std::string text = without_control_characters(reader.text());
      lose(text.substr(0, 1000));
      return;
    }
    case FromAgent::kAnswer: {
      const std::uint32_t number = reader.u32();
      const bool well = reader.flag();
      std::string text = reader.text();
      reader.end();
      const auto question = answers_.find(number);
      if (question == answers_.end() || question->second) {
        throw WireError("it answers what nobody has asked");
      }
      question->second = Answer{well, well ? std::move(text) : without_control_characters(std::move(text))};
      return;
    }
    case FromAgent::kPong:
      take_pong(reader);
      return;
    case FromAgent::kStarted:
    case FromAgent::kFailed:
    case FromAgent::kOutput:
    case FromAgent::kClosed:
    case FromAgent::kExited:
    case FromAgent::kGroups:
      runs_.receive(kind, reader);
      return;
    default:
      break;
  }
  if (kind >= FromAgent::kTraceTold && kind <= FromAgent::kTraceWish) {
    traces_.receive(kind, reader);
    return;
  }
  throw WireError("it sends a message of an unknown kind");
}

// While the loop is kept busy, as by a function of a Python launch file, the agent's messages wait in the pipe. So a
// look at the clock counts only if the pipe is empty.
void MachineConnection::watch_silence() {
  const Duration between = settings_.keepalive / 4;
  silence_timer_ = loop_.after(between, [this] {
    pollfd readable{command_->output(), POLLIN, 0};
    if (::poll(&readable, 1, 0) == 1 || suspended_) {
      last_heard_ = Clock::now();
    }
    if (Clock::now() - last_heard_ > settings_.keepalive) {
      lose(fmt::format("nothing has come for {} s", std::chrono::duration<double>(settings_.keepalive).count()));
    } else if (!lost_) {
      watch_silence();
    }
  });
}

std::string MachineConnection::last_words() const {
  constexpr std::size_t kShown = 3;
  const std::deque<std::string>& lines = command_->last_lines();
  const auto first = lines.begin() + static_cast<std::ptrdiff_t>(lines.size() - std::min(lines.size(), kShown));
  return fmt::format("{}", fmt::join(first, lines.end(), " | "));
}

void MachineConnection::lose(const std::string& reason, std::string help) {
  if (lost_) {
    return;
  }
  output_source_.reset();
  error_source_.reset();
  write_source_.reset();
  silence_timer_.reset();
  outgoing_->close();
  const std::string how = command_->end(reason.empty() ? kPatienceAfterLoss : milliseconds(0));
  const bool was_there = hello_.has_value();
  std::string why = reason.empty() ? fmt::format("'{}' {}", settings_.connect, how) : reason;
  if (!was_there && reason.empty()) {
    const int code = command_->exit_code();
    if (code == kCommandNotFound || code == kCommandNotExecutable) {
      help = fmt::format("is '{}' there? launch=\"PATH\" says where launch is on the machine",
                         settings_.words[settings_.words.size() - 2]);
    } else if (code == kNoConnectionOfSsh) {
      help = fmt::format("see whether '{} true' works", settings_.connect);
    } else {
      why += " before launch answered there";
      help = fmt::format("see what '{} {} --version' prints", settings_.connect,
                         settings_.words[settings_.words.size() - 2]);
    }
  }
  if (const std::string words = last_words(); !words.empty() && !was_there) {
    help = fmt::format("it wrote: {}{}{}", words, help.empty() ? "" : "; ", help);
  }
  help_ = std::move(help);
  lost_ = fmt::format("{} machine '{}'{}: {}", was_there ? "the connection to" : "no connection to", settings_.name,
                      was_there ? " is lost" : "", why);
  if (was_there) {
    const std::string labels = runs_.running_labels();
    const std::string rest = labels.empty() ? "" : "; what ran there: " + labels + "; the agent there ends it";
    const std::string words = command_->last_lines().empty() ? "" : "; it wrote last: " + command_->last_lines().back();
    tell_(LogLevel::kError, *lost_ + words + rest);
    observe_loss_({settings_.name, why, labels});
  }
  runs_.lose(*lost_);
  traces_.lose(*lost_);
}

void MachineConnection::throw_lost() const {
  throw MachineError(*lost_, help_);
}

}  // namespace launch
