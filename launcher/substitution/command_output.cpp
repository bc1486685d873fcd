// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/command_output.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>

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

[[noreturn]] void interrupt(pid_t pid) {
  ::kill(pid, SIGTERM);
  if (!ends_within(pid, std::chrono::seconds(1))) {
    ::kill(pid, SIGKILL);
  }
  wait_for(pid);
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
                              const Environment& environment, bool merge_error) {
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
                        {STDERR_FILENO, (merge_error ? out : error).write.get()}},
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
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    if (::poll(streams.data(), streams.size(), -1) < 0) {
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
  }
  const UniqueFd process(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
  std::array<pollfd, 2> end = {{{process.get(), POLLIN, 0}, {held.descriptor(), POLLIN, 0}}};
  while (process && ::poll(end.data(), end.size(), -1) < 0) {
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
