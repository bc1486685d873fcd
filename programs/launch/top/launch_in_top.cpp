// SPDX-License-Identifier: Apache-2.0
// `launch --top FILE`: a launch that is seen in `launch top` from its start on.
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "base/diagnostics/command_error.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/files/pipe.hpp"
#include "base/processes/spawn.hpp"
#include "launcher/control/control_client.hpp"
#include "programs/launch/command_functions.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

constexpr int kExitCodeOfEndedLaunch = 128;  // plus its number, as shells count

std::atomic<pid_t> launch_pid{0};

extern "C" void pass_on(int signal) {
  if (launch_pid > 0) {
    ::kill(launch_pid, signal);
  }
}

// Ctrl-C and the others are for the launch, and the view ends with it. ncurses leaves handlers that are there.
void pass_signals_on() {
  struct sigaction action {};
  action.sa_handler = pass_on;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    ::sigaction(signal, &action, nullptr);
  }
}

// Takes what a launch prints. Keeps the end of it until it is to be seen.
class LaunchLines {
 public:
  explicit LaunchLines(UniqueFd from) : from_(std::move(from)), thread_([this] { read(); }) {}
  // Reads what is there. A daemon that the launch leaves may hold the other end open for ever.
  ~LaunchLines() {
    ended_ = true;
    thread_.join();
  }
  LaunchLines(const LaunchLines&) = delete;
  LaunchLines& operator=(const LaunchLines&) = delete;

  // From now on everything is printed, after the last lines so far.
  void show() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!std::exchange(shown_, true)) {
      print(last_lines());
    }
  }

 private:
  static constexpr std::size_t kLines = 20;
  static constexpr std::size_t kMost = 64UL << 10U;

  std::string_view last_lines() const {
    std::size_t begin = kept_.size();
    for (std::size_t i = 0; i <= kLines && begin != std::string::npos && begin > 0; ++i) {
      begin = kept_.rfind('\n', begin - 1);
    }
    return std::string_view(kept_).substr(begin == std::string::npos || begin == 0 ? 0 : begin + 1);
  }

  static void print(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
  }

  void read() {
    constexpr int kTurn = 100;  // milliseconds
    std::array<char, 16UL << 10U> bytes{};
    for (;;) {
      pollfd readable{from_.get(), POLLIN, 0};
      const bool last = ended_;
      if (::poll(&readable, 1, last ? 0 : kTurn) <= 0) {
        if (last) {
          return;
        }
        continue;
      }
      const ssize_t count = ::read(from_.get(), bytes.data(), bytes.size());
      if (count <= 0) {
        return;
      }
      take(std::string_view(bytes.data(), static_cast<std::size_t>(count)));
    }
  }

  void take(std::string_view text) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (shown_) {
      print(text);
      return;
    }
    kept_ += text;
    if (kept_.size() > kMost) {
      kept_.erase(0, kept_.size() - kMost / 2);
    }
  }

  UniqueFd from_;
  std::mutex mutex_;
  std::string kept_;
  bool shown_ = false;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

// Whether the launch can be asked. False when it ends before, or is not there for a long time.
bool can_be_asked(pid_t pid, const Environment& environment) {
  const auto deadline = std::chrono::steady_clock::now() + 30s;
  do {
    for (const FoundLaunch& found : find_launches(environment)) {
      if (found.pid == pid) {
        return true;
      }
    }
  } while (!ends_within(pid, 20ms) && std::chrono::steady_clock::now() < deadline);
  return false;
}

void show_top(pid_t pid) {
  try {
    top_command({"--launch", fmt::format("{}", pid)});
  } catch (const ControlError& error) {
    fmt::print(stderr, "{}", command_error("launch", error.what(), error.help()));
  }
}

}  // namespace

int launch_in_top(std::vector<std::string> words, const Environment& environment) {
  if (::isatty(STDIN_FILENO) == 0 || ::isatty(STDOUT_FILENO) == 0) {
    fmt::print(stderr, "{}", usage_error("launch", "--top needs a terminal", "'launch ps' prints a table"));
    return kWrongCommandLine;
  }
  const std::string program = own_prefix() + "/bin/launch";
  words.insert(words.begin(), "launch");
  Pipe pipe = make_pipe();
  pass_signals_on();
  const pid_t pid = spawn(
      {.program = program,
       .argv = std::move(words),
       .descriptors = {{STDIN_FILENO, kDevNull}, {STDOUT_FILENO, pipe.write.get()}, {STDERR_FILENO, pipe.write.get()}},
       .only_given_descriptors = true,
       .group = ChildGroup::kOwn});
  launch_pid = pid;
  pipe.write.reset();
  int status = 0;
  {
    LaunchLines lines(std::move(pipe.read));
    if (can_be_asked(pid, environment)) {
      show_top(pid);
    }
    lines.show();
    // During waitpid(2) ThreadSanitizer keeps signals back.
    ends_within(pid, 24h);
    status = wait_for(pid);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : kExitCodeOfEndedLaunch + WTERMSIG(status);
}

}  // namespace launch
