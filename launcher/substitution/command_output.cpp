// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/command_output.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>

#include "launcher/base/pipe.hpp"
#include "launcher/base/spawn.hpp"

namespace launch {

namespace {

// Appends what can be read now; false at the end of the stream.
bool read_some(int fd, std::string& text) {
  std::array<char, 4096> buffer;
  const ssize_t count = ::read(fd, buffer.data(), buffer.size());
  if (count > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return count > 0 || (count < 0 && errno == EINTR);
}

}  // namespace

CommandOutput capture_command(const std::string& program, const std::vector<std::string>& argv,
                              const Environment& environment, bool merge_error) {
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
  std::array<pollfd, 2> streams = {{{out.read.get(), POLLIN, 0}, {error.read.get(), POLLIN, 0}}};
  std::array<std::string*, 2> texts = {&output.text, &output.error};
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    if (::poll(streams.data(), streams.size(), -1) < 0) {
      continue;
    }
    for (std::size_t i = 0; i < streams.size(); ++i) {
      if (streams[i].fd >= 0 && streams[i].revents != 0 && !read_some(streams[i].fd, *texts[i])) {
        streams[i].fd = -1;  // poll() skips it
      }
    }
  }
  output.status = wait_for(pid);
  return output;
}

std::string describe_status(int status) {
  return WIFSIGNALED(status) ? fmt::format("killed by signal {}", WTERMSIG(status))
                             : fmt::format("exit code {}", WEXITSTATUS(status));
}

}  // namespace launch
