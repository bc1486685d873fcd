// SPDX-License-Identifier: Apache-2.0
// What a visit waits for: the first words of an agent, and its answers.
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "launcher/machines/machine_connection.hpp"

namespace launch {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kLongestAnswer{30};

// Signals wait while a launch file is visited. One that asks for the end must not wait for a machine that hangs.
bool is_interrupted() {
  sigset_t waiting;
  return ::sigpending(&waiting) == 0 && (sigismember(&waiting, SIGINT) == 1 || sigismember(&waiting, SIGTERM) == 1 ||
                                         sigismember(&waiting, SIGHUP) == 1 || sigismember(&waiting, SIGQUIT) == 1);
}

}  // namespace

const AgentHello& MachineConnection::await_hello() {
  wait_until([this] { return hello_.has_value(); }, begun_, settings_.connect_timeout, "launch has not answered there");
  return *hello_;
}

std::string MachineConnection::ask(AgentQuestion what, const WireWriter& content) {
  await_hello();
  const std::uint32_t number = ++questions_;
  if (away_) {
    throw_lost();
  }
  answers_[number];
  WireWriter question;
  question.u32(number).u8(static_cast<std::uint8_t>(what)).rest(content.bytes());
  send(ToAgent::kAsk, question);
  try {
    wait_until([&] { return answers_[number].has_value(); }, Clock::now(), kLongestAnswer, "no answer has come");
  } catch (const MachineError&) {
    answers_.erase(number);
    unawaited_.insert(number);
    throw;
  }
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
    if (away_) {
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

void MachineConnection::throw_lost() const {
  if (away_) {
    throw MachineError(away_->why, "launch connects again, and can ask nothing there meanwhile");
  }
  throw MachineError(*lost_, help_);
}

}  // namespace launch
