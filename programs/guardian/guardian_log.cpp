// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/guardian_log.hpp"

#include <fcntl.h>
#include <poll.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "base/terminal/terminal.hpp"

namespace launch {
namespace {

// So much can be written to a pipe that poll(2) calls writable, without waiting for its reader.
constexpr std::size_t kNeverWaits = 4096;

// A screen that is not read must not stop the guardian: it loses lines then, and launch.log has them.
void write_to_screen(std::string_view text) {
  while (!text.empty()) {
    pollfd writable{STDOUT_FILENO, POLLOUT, 0};
    if (::poll(&writable, 1, 0) != 1 || (writable.revents & POLLOUT) == 0) {
      return;
    }
    const ssize_t written = ::write(STDOUT_FILENO, text.data(), std::min(text.size(), kNeverWaits));
    if (written <= 0) {
      return;
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

void GuardianLog::open(const std::string& path) {
  log_.reset(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
}

void GuardianLog::erase_status_line() {
  if (takes_control_sequences(STDOUT_FILENO) && ::tcgetpgrp(STDOUT_FILENO) == ::getpgrp()) {
    write_to_screen("\r\033[K");
  }
}

void GuardianLog::say(std::string_view level, std::string_view text) {
  write("[" + std::string(level) + "] [launch]: " + std::string(text) + "\n", true);
}

void GuardianLog::write_line(std::string_view label, std::string_view line, bool on_screen) {
  write("[" + std::string(label) + "] " + std::string(line) + "\n", on_screen);
}

void GuardianLog::write(std::string_view text, bool on_screen) {
  if (on_screen) {
    write_to_screen(text);
  }
  if (log_) {
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    std::array<char, 40> stamp{};
    const int size =
        std::snprintf(stamp.data(), stamp.size(), "%lld.%07ld ", static_cast<long long>(now.tv_sec), now.tv_nsec / 100);
    std::string line(stamp.data(), static_cast<std::size_t>(size));
    line += text;
    // A log that can't be written is no reason to stop.
    static_cast<void>(!::write(log_.get(), line.data(), line.size()));
  }
}

}  // namespace launch
