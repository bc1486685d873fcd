// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/command_output.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/files/pipe.hpp"
#include "base/files/unique_fd.hpp"
#include "base/processes/ending_signals.hpp"
#include "base/processes/spawn.hpp"

namespace launch {

namespace {

// Holds back the signals that ask this process to end, and tells that one has come. Whoever waits for signals, the
// launcher's loop for example, gets it at the end of the block.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t asking;
    sigemptyset(&asking);
    for (const int signal : kEndingSignals) {
      struct sigaction action {};
      // Blocked, an ignored signal would arrive.
      if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) {
        sigaddset(&asking, signal);
      }
    }
    ::pthread_sigmask(SIG_BLOCK, &asking, &before_);
    arrived_.reset(::signalfd(-1, &asking, SFD_CLOEXEC | SFD_NONBLOCK));
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

  // Is readable when a signal has come. Reading would take the signal.
  int descriptor() const { return arrived_.get(); }

 private:
  sigset_t before_{};
  UniqueFd arrived_;
};

// Sends the signal to the command and to what it has started. The command has no process group of its own: it may ask
// for a password on the terminal.
void signal_all(pid_t pid, int signal) {
  std::ifstream list(fmt::format("/proc/{0}/task/{0}/children", pid));
  const std::vector<pid_t> children{std::istream_iterator<pid_t>(list), {}};
  ::kill(pid, signal);
  for (const pid_t child : children) {
    signal_all(child, signal);
  }
}

void end_command(pid_t pid) {
  signal_all(pid, SIGTERM);
  if (!ends_within(pid, std::chrono::seconds(1))) {
    signal_all(pid, SIGKILL);
  }
  wait_for(pid);
}

[[noreturn]] void interrupt(pid_t pid) {
  end_command(pid);
  throw std::runtime_error("interrupted by a signal");
}

// Appends what can be read now; false at the end of the stream.
bool read_some(int fd, std::string& text) {
  std::array<char, 4096> buffer{};
  const ssize_t count = ::read(fd, buffer.data(), buffer.size());
  if (count > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return count > 0 || (count < 0 && errno == EINTR);
}

}  // namespace

CommandOutput capture_command(const std::string& program, const std::vector<std::string>& argv,
                              const Environment& environment, const CommandRules& rules) {
  const HeldSignals held;
  Pipe out = make_pipe();
  Pipe error = make_pipe();
  pid_t pid = 0;
  try {
    pid = spawn({
        .program = program,
        .argv = argv,
        .environment = &environment.variables(),
        .descriptors = {{STDIN_FILENO, kDevNull},
                        {STDOUT_FILENO, out.write.get()},
                        {STDERR_FILENO, (rules.merge_error ? out : error).write.get()}},
        // The launcher blocks signals that its loop reads; a program expects none to be blocked.
        .signals = ChildSignals::kNoneBlocked,
    });
  } catch (const SpawnError& failure) {
    throw std::runtime_error(failure.code().message());
  }
  out.write.reset();
  error.write.reset();

  CommandOutput output;
  std::array<pollfd, 3> streams = {
      {{out.read.get(), POLLIN, 0}, {error.read.get(), POLLIN, 0}, {held.descriptor(), POLLIN, 0}}};
  std::array<std::string*, 2> texts = {&output.text, &output.error};
  const auto give_up = [&](CommandOutput::GivenUp why) {
    end_command(pid);
    output.given_up = why;
    return std::move(output);
  };
  const auto begin = std::chrono::steady_clock::now();
  const auto patience = [&] {
    if (!rules.limit) {
      return -1;
    }
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(begin + *rules.limit - std::chrono::steady_clock::now());
    return static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, std::numeric_limits<int>::max()));
  };
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    const int ready = ::poll(streams.data(), streams.size(), patience());
    if (ready == 0 && patience() == 0) {
      return give_up(CommandOutput::GivenUp::kTookTooLong);
    }
    if (ready <= 0) {
      continue;
    }
    if (streams[2].revents != 0) {
      interrupt(pid);
    }
    for (std::size_t i = 0; i < texts.size(); ++i) {
      if (streams[i].fd >= 0 && streams[i].revents != 0 && !read_some(streams[i].fd, *texts[i])) {
        streams[i].fd = -1;  // poll() skips it
      }
    }
    if (output.text.size() + output.error.size() > kLargestCommandOutput) {
      return give_up(CommandOutput::GivenUp::kWroteTooMuch);
    }
    if (patience() == 0) {
      return give_up(CommandOutput::GivenUp::kTookTooLong);  // it writes all the time
    }
  }
  const UniqueFd process(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
  std::array<pollfd, 2> end = {{{process.get(), POLLIN, 0}, {held.descriptor(), POLLIN, 0}}};
  for (int ready = -1; process && ready <= 0;) {
    ready = ::poll(end.data(), end.size(), patience());
    if (ready == 0 && patience() == 0) {
      return give_up(CommandOutput::GivenUp::kTookTooLong);
    }
  }
  if (end[0].revents == 0 && end[1].revents != 0) {
    interrupt(pid);
  }
  output.status = wait_for(pid);
  return output;
}

std::string describe_status(int status) {
  return WIFSIGNALED(status) ? fmt::format("killed by signal {}", WTERMSIG(status))
                             : fmt::format("exit code {}", WEXITSTATUS(status));
}

}  // namespace launch
