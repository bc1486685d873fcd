// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/steer/attached_terminal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>

#include "base/processes/ending_signals.hpp"
#include "base/terminal/terminal.hpp"
#include "base/text/base64.hpp"

namespace launch {
namespace {

using Json = ControlClient::Json;

constexpr std::size_t kMostKeys = std::size_t{64} * 1024;  // until the launch takes it
constexpr std::size_t kInputOfRequest = std::size_t{16} * 1024;

// A terminal that stops, by Ctrl-S or because it is far away, must not stop this program: signals and keys are taken
// meanwhile. The copy has flags of its own, so that others who share the terminal see no change.
UniqueFd output_without_waiting() {
  struct stat file {};
  UniqueFd fd;
  if (::isatty(STDOUT_FILENO) != 0 || (::fstat(STDOUT_FILENO, &file) == 0 && S_ISFIFO(file.st_mode))) {
    fd.reset(::open("/proc/self/fd/1", O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  }
  if (!fd) {
    fd.reset(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0));
  }
  return fd;
}

}  // namespace

AttachedTerminal::AttachedTerminal(ControlClient& launch, Options options)
    : launch_(launch),
      options_(std::move(options)),
      keys_are_typed_(::isatty(STDIN_FILENO) != 0),
      shows_screen_(::isatty(STDOUT_FILENO) != 0),
      output_(output_without_waiting()),
      reads_input_(keys_are_typed_ || !options_.read_only) {
  ::signal(SIGPIPE, SIG_IGN);
  sigset_t taken;
  sigemptyset(&taken);
  for (const int signal : kEndingSignals) {
    sigaddset(&taken, signal);
  }
  for (const int signal : {SIGWINCH, SIGTSTP, SIGCONT}) {
    sigaddset(&taken, signal);
  }
  ::sigprocmask(SIG_BLOCK, &taken, nullptr);
  signals_.reset(::signalfd(-1, &taken, SFD_CLOEXEC | SFD_NONBLOCK));
}

AttachedTerminal::End AttachedTerminal::run() {
  if (keys_are_typed_) {
    raw_.emplace(options_.read_only);
  }
  if (!options_.greeting.empty()) {
    fmt::print(stderr, "{}\r\n", options_.greeting);
  }
  try {
    receive();  // what has come with the answer
    while (!over_ && !(launch_.ended() && shown_.empty())) {
      turn();
    }
  } catch (...) {
    set_back();
    throw;
  }
  set_back();
  return end_;
}

void AttachedTerminal::turn() {
  // What the process prints waits in the launch while this side shows nothing.
  const bool may_show = shown_.empty();
  std::array<pollfd, 4> waits{{{signals_.get(), POLLIN, 0},
                               {may_show && !launch_.ended() ? launch_.fd() : -1, POLLIN, 0},
                               {reads_input_ && typed_.size() < kMostKeys ? STDIN_FILENO : -1, POLLIN, 0},
                               {may_show ? -1 : output_.get(), POLLOUT, 0}}};
  if (::poll(waits.data(), waits.size(), -1) < 0) {
    return;
  }
  if (waits[0].revents != 0) {
    take_signal();
  }
  if (waits[2].revents != 0) {
    take_keys();
  }
  if (waits[1].revents != 0) {
    receive();
  }
  if (!shown_.empty()) {
    write();
  }
  over_ = over_ || (end_.process && shown_.empty());
}

void AttachedTerminal::receive() {
  while (const std::optional<Json> event = launch_.next(std::chrono::milliseconds(0))) {
    obey(*event);
  }
}

void AttachedTerminal::obey(const Json& event) {
  if (event.contains("ok")) {
    if (event.contains("taken")) {
      waits_for_terminal_ = false;
      send_typed();
    }
    return;
  }
  const std::string what = event.value("event", "");
  if (what == "terminal") {
    const std::string bytes = from_base64(event.value("data", "")).value_or("");
    modes_.add(bytes);
    shown_ += bytes;
  } else if (what == "terminal_dropped") {
    const std::string text =
        fmt::format("[launch attach: {} bytes came too fast and are left out]", event.value("bytes", std::size_t{0}));
    if (shows_screen_) {
      shown_ += "\r\n" + text + "\r\n";
    } else {
      fmt::print(stderr, "{}\n", text);
    }
  } else if (what == "terminal_ended") {
    end_.process = event;
  }
}

void AttachedTerminal::take_keys() {
  std::array<char, 4096> keys;  // not initialised: it is read into
  const ssize_t count = ::read(STDIN_FILENO, keys.data(), keys.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) {
    return;
  }
  if (count <= 0) {
    reads_input_ = false;
    if (keys_are_typed_) {
      end_.signal = SIGHUP;  // the terminal has gone
      over_ = true;
    }
    return;
  }
  const std::string_view given(keys.data(), static_cast<std::size_t>(count));
  if (!keys_are_typed_) {
    typed_ += given;
  } else {
    const DetachKeys::Outcome outcome = options_.detach_keys.add(given);
    typed_ += options_.read_only ? "" : outcome.passed;
    if (outcome.detached) {
      send_typed();
      end_.detached = over_ = true;
      return;
    }
  }
  send_typed();
}

// The terminal of the process takes one piece after the other, so that nothing is lost however slowly it reads.
void AttachedTerminal::send_typed() {
  if (!waits_for_terminal_ && !typed_.empty()) {
    launch_.tell({{"do", "input"}, {"data", to_base64(std::string_view(typed_).substr(0, kInputOfRequest))}});
    typed_.erase(0, kInputOfRequest);
    waits_for_terminal_ = true;
  }
}

void AttachedTerminal::take_signal() {
  signalfd_siginfo info{};
  if (::read(signals_.get(), &info, sizeof info) != static_cast<ssize_t>(sizeof info)) {
    return;
  }
  const int signal = static_cast<int>(info.ssi_signo);
  if (asks_to_end(signal)) {
    end_.signal = signal;
    over_ = true;
    return;
  }
  if (signal == SIGTSTP) {
    raw_.reset();
    ::raise(SIGSTOP);
  }
  if (keys_are_typed_ && signal != SIGWINCH) {
    // A shell has set its own modes meanwhile.
    raw_.reset();
    raw_.emplace(options_.read_only);
  }
  if (shows_screen_ && !launch_.ended()) {
    const TerminalSize size = terminal_size(STDOUT_FILENO);
    launch_.tell({{"do", "resize"}, {"columns", size.columns}, {"lines", size.lines}});
  }
}

void AttachedTerminal::write() {
  const ssize_t count = ::write(output_.get(), shown_.data(), shown_.size());
  if (count > 0) {
    end_.cut_line = shown_[static_cast<std::size_t>(count) - 1] != '\n';
    shown_.erase(0, static_cast<std::size_t>(count));
  } else if (errno != EAGAIN && errno != EINTR) {
    end_.signal = shows_screen_ ? SIGHUP : SIGPIPE;
    over_ = true;
  }
}

void AttachedTerminal::set_back() {
  if (shows_screen_ && takes_control_sequences(STDOUT_FILENO)) {
    const std::string text = modes_.leaving();
    static_cast<void>(!::write(output_.get(), text.data(), text.size()));  // a terminal that hangs gets nothing
  }
  raw_.reset();
}

}  // namespace launch
