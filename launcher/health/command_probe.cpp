// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/command_probe.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <system_error>
#include <utility>
#include <vector>

#include "launcher/process/process_messages.hpp"

namespace launch {
namespace {

constexpr std::size_t kMostWords = 200;  // bytes of its output that are told
constexpr int kReapTimeoutMilliseconds = 1000;

bool has_exited(const Process& process) {
  pollfd exited{process.pidfd.get(), POLLIN, 0};
  return ::poll(&exited, 1, 0) == 1;
}

}  // namespace

struct CommandProbe::Run {
  Process process;
  std::string output;  // the end of it
  ProcessorWait wait;
  Duration allowed{0};
  EventLoop::SourcePtr out;
  EventLoop::SourcePtr err;
  EventLoop::SourcePtr exit;
  EventLoop::SourcePtr timeout;
};

CommandProbe::~CommandProbe() {
  abandon();
  for (const std::shared_ptr<Run>& run : abandoned_) {
    pollfd exited{run->process.pidfd.get(), POLLIN, 0};
    if (::poll(&exited, 1, kReapTimeoutMilliseconds) == 1) {
      runner_.reap(run->process);
    }
  }
}

Look CommandProbe::look(Duration, Duration) {
  if (run_) {
    return {};
  }
  const auto run = std::make_shared<Run>();
  try {
    run->process = runner_.spawn(command_);
  } catch (const std::system_error& error) {
    return {Look::Result::kBad, fmt::format("the command of its watch can't be started: {}", error.what())};
  }
  run_ = run;
  run->wait.of_process(run->process.pid, timeout_);
  for (const auto& [fd, source] : {std::pair(run->process.out.get(), &run->out), {run->process.err.get(), &run->err}}) {
    if (fd >= 0 && ::fcntl(fd, F_SETFL, O_NONBLOCK) == 0) {
      *source = loop_.on_readable(fd, [this] { read(); });
    }
  }
  run->exit = loop_.on_exit(run->process.pidfd.get(), [this] { on_exit(); });
  run->timeout = loop_.after(timeout_, [this] { on_timeout(); });
  return {};
}

void CommandProbe::read() {
  for (const auto& [fd, source] :
       {std::pair(run_->process.out.get(), &run_->out), {run_->process.err.get(), &run_->err}}) {
    std::array<char, 4096> part{};
    for (ssize_t count = 0; *source && (count = ::read(fd, part.data(), part.size())) >= 0;) {
      if (count == 0) {
        source->reset();
        break;
      }
      run_->output.append(part.data(), static_cast<std::size_t>(count));
      if (run_->output.size() > part.size()) {
        run_->output.erase(0, run_->output.size() - part.size());
      }
    }
  }
}

void CommandProbe::on_exit() {
  read();
  const std::shared_ptr<Run> run = run_;
  runner_.signal_group(run->process, SIGKILL);  // what it has left running
  const ProcessExit exit = runner_.reap(run->process);
  const std::string words = last_words();
  run_.reset();
  answer_(exit.code == 0
              ? Look{Look::Result::kGood}
              : Look{Look::Result::kBad, fmt::format("the command of its watch has ended with {}{}", end_of(exit),
                                                     words.empty() ? "" : fmt::format(" ({})", words))});
}

void CommandProbe::on_timeout() {
  if (has_exited(run_->process)) {
    return;  // the loop tells of it next
  }
  const Duration waited = run_->wait.of_process(run_->process.pid, timeout_);
  if (waited > timeout_ / 4) {
    run_->timeout = loop_.after(waited, [this] { on_timeout(); });
    return;
  }
  abandon();
  answer_({Look::Result::kBad, fmt::format("the command of its watch has not ended within {} s",
                                           std::chrono::duration<double>(timeout_).count())});
}

void CommandProbe::abandon() {
  if (!run_) {
    return;
  }
  const std::shared_ptr<Run> run = std::exchange(run_, nullptr);
  run->out.reset();
  run->err.reset();
  run->timeout.reset();
  run->exit.reset();  // a descriptor can't be watched twice
  runner_.signal_group(run->process, SIGKILL);
  abandoned_.push_back(run);
  run->exit = loop_.on_exit(run->process.pidfd.get(), [this, ended = run.get()] {
    runner_.reap(ended->process);
    std::erase_if(abandoned_, [ended](const std::shared_ptr<Run>& each) { return each.get() == ended; });
  });
}

std::string CommandProbe::last_words() const {
  std::string text = run_->output;
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) {
    text.pop_back();
  }
  text.erase(0, text.rfind('\n') + 1);
  return text.substr(0, kMostWords);
}

}  // namespace launch
