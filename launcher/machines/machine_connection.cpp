// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/machine_connection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <signal.h>
#include <sys/random.h>
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

constexpr seconds kPatienceAtEnd{30};  // for the guardian there, which ends what processes have left
constexpr std::size_t kLongestBanner = 64 * 1024;
constexpr int kPingsForATrace = 32;  // at its begin and at its end, to compare the clocks

std::int64_t in_milliseconds(Duration time) {
  return std::chrono::duration_cast<milliseconds>(time).count();
}

// 128 bits that nobody can guess, hexadecimal. Throws std::system_error.
std::string random_number() {
  std::array<std::uint64_t, 2> bits{};
  if (::getrandom(bits.data(), sizeof bits, 0) != sizeof bits) {
    throw std::system_error(errno, std::system_category(), "cannot make a random number");
  }
  return fmt::format("{:016x}{:016x}", bits[0], bits[1]);
}

}  // namespace

MachineConnection::MachineConnection(EventLoop& loop, Settings settings, Tell tell)
    : loop_(loop),
      settings_(std::move(settings)),
      tell_(std::move(tell)),
      runs_(loop, [this](ToAgent kind, const WireWriter& content) { send(kind, content); }),
      traces_(loop, settings_.name, clock_, [this](ToAgent kind, const WireWriter& content) { send(kind, content); }) {
  try {
    start_command();
  } catch (const std::system_error& error) {
    lost_ = fmt::format("no connection to machine '{}': {}", settings_.name, error.what());
    help_ = "connect needs a command, such as 'ssh robot'";
  }
}

void MachineConnection::start_command() {
  command_ = std::make_unique<ConnectingCommand>(settings_.words);
  if (outgoing_ == nullptr) {
    outgoing_ = std::make_unique<Outgoing>(command_->take_input());
  } else {
    outgoing_->use(command_->take_input());
  }
  output_source_ = loop_.on_readable(command_->output(), [this] { receive(); });
  error_source_ = loop_.on_readable(command_->error(), [this] {
    if (!command_->read_error(hello_ && !away_ ? teller() : nullptr)) {  // of tries, the last one is told
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
  if (away_) {
    away_->timer.reset();
    tell_(LogLevel::kWarning, fmt::format("machine '{}' is away; the agent there ends {} s after the loss",
                                          settings_.name, std::chrono::duration<double>(settings_.keep_for).count()));
  } else if (!lost_ && greeted_) {
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
  command_->end(greeted_ && !lost_ && !away_ ? milliseconds(500) : milliseconds(0));
}

std::function<void(std::string_view line)> MachineConnection::teller() const {
  return
      [this](std::string_view line) { tell_(LogLevel::kInfo, fmt::format("machine '{}': {}", settings_.name, line)); };
}

void MachineConnection::send(ToAgent kind, const WireWriter& content) {
  if (lost_ || !outgoing_ || (away_ && kind == ToAgent::kGroups)) {  // which is asked again and again
    return;
  }
  std::string frame = encode(kind, content);
  const bool taken = !away_ && outgoing_->add(frame);
  if (settings_.keep && is_numbered(kind)) {
    kept_.add(std::move(frame));
  }
  if (!taken) {
    return;  // the end of its output comes, too, and tells why; or it is sent when the machine is back
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

void MachineConnection::receive() {
  std::array<char, 64UL * 1024> bytes;  // not initialised: it is read into
  const ssize_t count = ::read(command_->output(), bytes.data(), bytes.size());
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
    return;
  }
  if (count <= 0) {
    cut("");
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
      if (is_numbered(static_cast<FromAgent>(frame->kind))) {
        received_.count(frame->content.size());
      }
      dispatch(*frame);
    }
    acknowledge(false);
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
    if (away_) {
      outgoing_->add(
          encode(ToAgent::kResume, WireWriter().rest(to_wire(ResumeRequest{setup_.id, setup_.key, received_.tell()}))));
      watch_output();
    } else {
      send_setup();
    }
    return;
  }
  if (before_greeting_.size() > kLongestBanner) {
    before_greeting_.erase(0, before_greeting_.size() - kLongestBanner / 2);
  }
}

void MachineConnection::send_setup() {
  setup_.setup = settings_.setup;
  setup_.name = settings_.name;
  // This side tells its user first that the connection is lost.
  setup_.silence_milliseconds = static_cast<std::uint32_t>(in_milliseconds(2 * settings_.keepalive));
  setup_.wait_milliseconds =
      static_cast<std::uint32_t>(in_milliseconds(settings_.keep ? settings_.keep_for : settings_.grace));
  if (settings_.keep) {
    setup_.id = random_number();
    setup_.key = random_number();
  }
  send(ToAgent::kSetup, WireWriter().rest(to_wire(setup_)));
}

void MachineConnection::dispatch(const Frame& frame) {
  WireReader reader(frame.content);
  const auto kind = static_cast<FromAgent>(frame.kind);
  if (away_ && kind == FromAgent::kPong) {
    return;  // a ping was on its way when the connection was cut
  }
  if (away_ && kind != FromAgent::kResumed && kind != FromAgent::kGone && kind != FromAgent::kRefused) {
    throw WireError("it goes on before it has said how far it got");
  }
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
      if (unawaited_.erase(number) > 0) {
        return;
      }
      const auto question = answers_.find(number);
      if (question == answers_.end() || question->second) {
        throw WireError("it answers what nobody has asked");
      }
      question->second = Answer{well, well ? std::move(text) : without_control_characters(std::move(text))};
      return;
    }
    case FromAgent::kPong:
      take_pong(reader);
      acknowledge(true);
      return;
    case FromAgent::kResumed:
      if (!away_) {
        throw WireError("it comes back, and was not away");
      }
      come_back(reader);
      return;
    case FromAgent::kGone: {
      const std::string text = without_control_characters(reader.text()).substr(0, 1000);
      reader.end();
      if (!away_) {
        throw WireError("it has gone, and was not away");
      }
      away_->gone = true;
      lose(text);
      return;
    }
    case FromAgent::kAcknowledge: {
      const std::uint64_t count = reader.u64();
      reader.end();
      if (!settings_.keep) {
        throw WireError("it acknowledges what has no number");
      }
      kept_.acknowledge(count);
      return;
    }
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

}  // namespace launch
