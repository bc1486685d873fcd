// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/connecting_command.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "base/files/pipe.hpp"
#include "base/processes/spawn.hpp"
#include "base/text/quoted_text.hpp"

namespace launch {
namespace {

constexpr std::size_t kLinesKept = 10;
constexpr std::size_t kLongestErrorLine = 1000;  // bytes; the rest of a longer one is a line of its own
constexpr std::chrono::seconds kAfterSigterm{2};

void make_non_blocking(const UniqueFd& fd) {
  ::fcntl(fd.get(), F_SETFL, ::fcntl(fd.get(), F_GETFL) | O_NONBLOCK);
}

}  // namespace

ConnectingCommand::ConnectingCommand(const std::vector<std::string>& words) {
  Pipe input = make_pipe();
  Pipe output = make_pipe();
  Pipe error = make_pipe();
  // The source of a descriptor must have a higher number than those before it (spawn.hpp).
  const auto high = [](const UniqueFd& fd) { return UniqueFd(::fcntl(fd.get(), F_DUPFD_CLOEXEC, 16)); };
  const UniqueFd in = high(input.read);
  const UniqueFd out = high(output.write);
  const UniqueFd err = high(error.write);
  pid_ = spawn({.program = words.front(),
                .argv = words,
                .search_path = true,
                .descriptors = {{STDIN_FILENO, in.get()}, {STDOUT_FILENO, out.get()}, {STDERR_FILENO, err.get()}},
                .only_given_descriptors = true,
                .group = ChildGroup::kOwnSession,
                .signals = ChildSignals::kFresh});
  how_ = "has not ended";
  input_ = std::move(input.write);
  output_ = std::move(output.read);
  error_ = std::move(error.read);
  make_non_blocking(output_);
  make_non_blocking(error_);
}

ConnectingCommand::~ConnectingCommand() {
  end(std::chrono::milliseconds(0));
}

bool ConnectingCommand::read_error(const std::function<void(std::string_view line)>& tell) {
  const auto take = [&](std::string line) {
    line = without_control_characters(std::move(line));
    if (tell) {
      tell(line);
    }
    lines_.push_back(std::move(line));
    if (lines_.size() > kLinesKept) {
      lines_.pop_front();
    }
  };
  std::array<char, 4096> bytes;  // not initialised: it is read into
  while (error_) {
    const ssize_t count = ::read(error_.get(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) {
      continue;
    }
    if (count < 0 && errno == EAGAIN) {
      return true;
    }
    if (count <= 0) {
      error_.reset();
      break;
    }
    rest_.append(bytes.data(), static_cast<std::size_t>(count));
    for (std::size_t end; (end = rest_.find('\n')) != std::string::npos || rest_.size() > kLongestErrorLine;) {
      end = std::min(end, kLongestErrorLine);
      std::string line = rest_.substr(0, end);
      rest_.erase(0, end + (rest_[end] == '\n' ? 1 : 0));
      if (line.ends_with('\r')) {
        line.pop_back();
      }
      take(std::move(line));
    }
  }
  if (!rest_.empty()) {
    take(std::exchange(rest_, {}));
  }
  return false;
}

bool ConnectingCommand::ends_by_itself(std::chrono::milliseconds patience) const {
  return pid_ < 0 || ends_within(pid_, patience);
}

std::string ConnectingCommand::end(std::chrono::milliseconds patience) {
  if (pid_ < 0) {
    return how_;
  }
  input_.reset();
  bool by_us = false;
  if (!ends_within(pid_, patience)) {
    by_us = true;
    // Of all that the command has started for itself, such as a proxy.
    ::kill(-pid_, SIGTERM);
    ::kill(-pid_, SIGCONT);  // one that is stopped would not end, and the launch would wait for it
    if (!ends_within(pid_, kAfterSigterm)) {
      ::kill(-pid_, SIGKILL);
    }
  }
  const int status = wait_for(std::exchange(pid_, -1));
  read_error({});
  if (by_us) {
    how_ = "did not end by itself";
  } else if (WIFEXITED(status)) {
    exit_code_ = WEXITSTATUS(status);
    how_ = fmt::format("ended with exit code {}", exit_code_);
  } else {
    const char* const name = ::sigabbrev_np(WTERMSIG(status));
    how_ = fmt::format("was ended by SIG{}", name == nullptr ? "?" : name);
  }
  return how_;
}

}  // namespace launch
