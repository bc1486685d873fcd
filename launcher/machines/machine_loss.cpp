// SPDX-License-Identifier: Apache-2.0
// How a connection to a machine is lost, for good or for now, and how it comes back.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

#include "launcher/machines/machine_connection.hpp"

namespace launch {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kPatienceAfterLoss{300};  // for the command to say why
constexpr int kCommandNotFound = 127;
constexpr int kCommandNotExecutable = 126;
constexpr int kNoConnectionOfSsh = 255;

constexpr milliseconds kFirstPause{500};  // before the first try to connect again; each other one is twice as long
constexpr seconds kLongestPause{5};
constexpr std::size_t kMostKept = 64UL * 1024 * 1024;  // bytes that the agent has not acknowledged
constexpr seconds kPatienceWithEnd{5};                 // for a machine that is away when the launch ends

double seconds_of(Duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

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
      cut(fmt::format("nothing has come for {} s", std::chrono::duration<double>(settings_.keepalive).count()));
    } else {
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

// The command may tell by itself why it ends.
std::string MachineConnection::end_command(bool by_itself) {
  output_source_.reset();
  error_source_.reset();
  write_source_.reset();
  silence_timer_.reset();
  outgoing_->close();
  return command_->end(by_itself ? kPatienceAfterLoss : milliseconds(0));
}

void MachineConnection::cut(const std::string& reason) {
  if (lost_) {
    return;
  }
  if (!hello_ || !settings_.keep) {
    lose(reason);
    return;
  }
  const std::string how = end_command(reason.empty());
  const std::string why = reason.empty() ? fmt::format("'{}' {}", settings_.connect, how) : reason;
  if (away_) {
    away_->last = why;
    if (const std::string words = last_words(); !words.empty()) {
      away_->last += "; it wrote: " + words;
    }
  } else {
    be_away(why);
  }
  try_later();
}

void MachineConnection::lose(const std::string& reason, std::string help) {
  if (lost_) {
    return;
  }
  const std::string how = end_command(reason.empty());
  const std::unique_ptr<Away> away = std::move(away_);
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
    const std::string rest =
        labels.empty() ? "" : fmt::format("; what ran there: {}; {}", labels, who_ends_it(away.get()));
    if (away) {
      tell_(LogLevel::kError, fmt::format("machine '{}' does not come back: {}{}", settings_.name, why, rest));
    } else {
      tell_(LogLevel::kError, *lost_ + last_words_of_agent() + rest);
      observe_loss_({settings_.name, why, labels});
    }
  }
  runs_.lose(*lost_);
  traces_.lose(*lost_);
}

std::string MachineConnection::who_ends_it(const Away* away) const {
  if (away == nullptr) {
    return settings_.grace > Duration{0} && !settings_.keep
               ? fmt::format("the agent there ends it after {} s", seconds_of(settings_.grace))
               : "the agent there ends it";
  }
  return away->gone ? "the guardian there ends it"
                    : fmt::format("the agent there ends it {} s after the loss", seconds_of(settings_.keep_for));
}

std::string MachineConnection::last_words_of_agent() const {
  return command_->last_lines().empty() ? "" : "; it wrote last: " + command_->last_lines().back();
}

void MachineConnection::be_away(const std::string& why) {
  const Clock::time_point now = Clock::now();
  const std::string labels = runs_.running_labels();
  expects_pings_ = false;
  away_ = std::make_unique<Away>();
  away_->why = fmt::format("the connection to machine '{}' is lost: {}", settings_.name, why);
  away_->begin = now;
  // The agent may notice the loss later than this side does.
  away_->end = now + std::chrono::duration_cast<Clock::duration>(
                         ends_ ? kPatienceWithEnd : Duration(settings_.keep_for + 2 * settings_.keepalive));
  away_->pause = kFirstPause;
  tell_(LogLevel::kError, fmt::format("{}{}; {}; launch connects again", away_->why, last_words_of_agent(),
                                      labels.empty() ? "nothing runs there"
                                                     : fmt::format("what runs there goes on for {} s: {}",
                                                                   seconds_of(settings_.keep_for), labels)));
  observe_loss_({settings_.name, why, labels});
}

void MachineConnection::try_later() {
  const Clock::time_point now = Clock::now();
  if (now >= away_->end) {
    lose(fmt::format("there was no connection for {:.1f} s{}", seconds_of(now - away_->begin),
                     away_->last.empty() ? "" : ", at last because " + away_->last));
    return;
  }
  const Duration pause = std::min<Duration>(away_->pause, away_->end - now);
  away_->pause = std::min<Duration>(2 * away_->pause, kLongestPause);
  away_->timer = loop_.after(pause, [this] { try_again(); });
}

void MachineConnection::try_again() {
  greeted_ = false;
  before_greeting_.clear();
  frames_ = {};
  try {
    start_command();
  } catch (const std::system_error& error) {
    away_->last = error.what();
    try_later();
    return;
  }
  await_greeting();
}

void MachineConnection::await_greeting() {
  const Duration patience =
      std::min<Duration>(settings_.connect_timeout, std::max<Duration>(away_->end - Clock::now(), kFirstPause));
  away_->timer = loop_.after(
      patience, [this, patience] { cut(fmt::format("launch has not answered there for {} s", seconds_of(patience))); });
}

void MachineConnection::expect_end() {
  ends_ = true;
  if (!away_) {
    return;
  }
  tell_(LogLevel::kInfo, fmt::format("machine '{}' is away; launch tries to reach it for {} s before it ends",
                                     settings_.name, kPatienceWithEnd.count()));
  away_->end = std::min(away_->end, Clock::now() + kPatienceWithEnd);
  away_->pause = kFirstPause;
  if (output_source_) {
    await_greeting();  // a try is under way, and has less time from now on
  } else {
    away_->timer = loop_.after(Duration{0}, [this] { try_again(); });
  }
}

void MachineConnection::come_back(WireReader& reader) {
  const std::uint64_t received = reader.u64();
  std::uint64_t dropped = 0;
  std::vector<std::string> told;
  for (std::uint32_t left = reader.count(sizeof(std::uint32_t) + sizeof(std::uint64_t)); left > 0; --left) {
    const std::uint32_t run = reader.u32();
    const std::uint64_t lines = reader.u64();
    dropped += lines;
    told.push_back(fmt::format("{} of {}", lines, runs_.label(run)));
  }
  reader.end();
  kept_.acknowledge(received);
  const std::unique_ptr<Away> away = std::move(away_);
  for (const std::string& frame : kept_.waiting()) {
    outgoing_->add(frame);
  }
  expects_pings_ = true;
  last_heard_ = Clock::now();
  watch_silence();
  if (more_pings_ > 0) {
    ping();
  }
  watch_output();
  const Duration time = Clock::now() - away->begin;
  tell_(LogLevel::kInfo, fmt::format("machine '{}' is back after {:.1f} s", settings_.name, seconds_of(time)));
  if (dropped > 0) {
    constexpr std::size_t kShown = 10;
    const std::string more = told.size() > kShown ? fmt::format(" and {} other processes", told.size() - kShown) : "";
    told.resize(std::min(told.size(), kShown));
    tell_(LogLevel::kWarning, fmt::format("while machine '{}' was away, lines of output were dropped: {}{}",
                                          settings_.name, fmt::join(told, ", "), more));
  }
  observe_return_({settings_.name, time, dropped});
}

void MachineConnection::acknowledge(bool at_once) {
  if (!settings_.keep || away_ || lost_) {
    return;
  }
  if (kept_.bytes() > kMostKept) {
    throw WireError("it acknowledges nothing");
  }
  if (at_once ? received_.is_new() : received_.is_much()) {
    send(ToAgent::kAcknowledge, WireWriter().u64(received_.tell()));
  }
}

}  // namespace launch
