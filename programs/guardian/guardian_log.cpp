// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/guardian_log.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "base/terminal/terminal.hpp"

namespace launch {

namespace {

// So much can be written to a pipe that poll(2) calls writable, without waiting for its reader.
constexpr std::size_t kNeverWaits = 4096;

// A screen that is not read must not stop the guardian: it loses lines then, and launch.log has them.
void write_to_screen(std::string_view text, int screen = STDOUT_FILENO) {
  while (!text.empty()) {
    pollfd writable{screen, POLLOUT, 0};
    if (::poll(&writable, 1, 0) != 1 || (writable.revents & POLLOUT) == 0) {
      return;
    }
    const ssize_t written = ::write(screen, text.data(), std::min(text.size(), kNeverWaits));
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

void GuardianLog::error(std::string_view text) {
  write_to_screen(text, STDERR_FILENO);
  write(text, false);
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

namespace {

constexpr std::size_t kLongestLine = 1024 * 1024;
constexpr std::size_t kReadsInOneTurn = 16;  // so that a process that floods its output can't keep the guardian busy

// Whether the descriptor of the process is open for reading and writing. A pipe of a shell is not.
bool is_open_for_both(const std::string& process, const std::string& number) {
  const UniqueFd fd(::open((process + "/fdinfo/" + number).c_str(), O_RDONLY | O_CLOEXEC));
  std::array<char, 256> text{};
  if (!fd || ::read(fd.get(), text.data(), text.size() - 1) <= 0) {
    return false;
  }
  const std::string_view info(text.data());
  const std::size_t flags = info.find("flags:");
  return flags != std::string_view::npos && (std::strtoul(text.data() + flags + 6, nullptr, 8) & O_ACCMODE) == O_RDWR;
}

}  // namespace

void LeftOutput::follow(const FoundProcess& found, const ProcessMark& mark) {
  const std::string process = proc_directory(found);
  for (const int number : {STDOUT_FILENO, STDERR_FILENO}) {
    const std::string name = std::to_string(number);
    const std::string path = process + "/fd/" + name;
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0 || !S_ISFIFO(status.st_mode)) {
      continue;
    }
    const std::pair<dev_t, ino_t> pipe(status.st_dev, status.st_ino);
    const bool known =
        std::any_of(streams_.begin(), streams_.end(), [&](const Stream& stream) { return stream.pipe == pipe; });
    if (known || !is_open_for_both(process, name)) {
      continue;
    }
    UniqueFd fd(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (fd) {
      const bool on_screen = number == STDOUT_FILENO ? mark.out_on_screen : mark.error_on_screen;
      streams_.push_back({std::move(fd), pipe, mark.label.empty() ? "launch" : mark.label, on_screen, {}});
    }
  }
}

void LeftOutput::add_to(std::vector<pollfd>& descriptors) const {
  for (const Stream& stream : streams_) {
    if (stream.fd) {
      descriptors.push_back({stream.fd.get(), POLLIN, 0});
    }
  }
}

void LeftOutput::read(bool last) {
  for (Stream& stream : streams_) {
    read(stream);
    if ((last || !stream.fd) && !stream.rest.empty()) {
      log_.write_line(stream.label, stream.rest, stream.on_screen);
      stream.rest.clear();
    }
  }
}

void LeftOutput::read(Stream& stream) {
  std::array<char, 16384> buffer;  // not initialised: it is read into
  for (std::size_t turn = 0; stream.fd && turn < kReadsInOneTurn; ++turn) {
    const ssize_t count = ::read(stream.fd.get(), buffer.data(), buffer.size());
    if (count <= 0) {
      if (count == 0) {
        stream.fd.reset();  // no process holds it any more
      }
      return;
    }
    stream.rest.append(buffer.data(), static_cast<std::size_t>(count));
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = stream.rest.find('\n', begin)) != std::string::npos; begin = end + 1) {
      log_.write_line(stream.label, std::string_view(stream.rest).substr(begin, end - begin), stream.on_screen);
    }
    stream.rest.erase(0, begin);
    if (stream.rest.size() > kLongestLine) {
      log_.write_line(stream.label, stream.rest, stream.on_screen);
      stream.rest.clear();
    }
  }
}

}  // namespace launch
