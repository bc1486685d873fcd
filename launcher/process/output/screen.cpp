// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/output/screen.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "base/terminal/terminal.hpp"

namespace launch {
namespace {

using Clock = std::chrono::steady_clock;

// So much can be written to a pipe that poll(2) calls writable, without waiting for its reader.
constexpr std::size_t kNeverWaits = 4096;

constexpr std::size_t kChunk = 64 * 1024;

bool is_writable(int fd, std::chrono::milliseconds timeout) {
  pollfd writable{fd, POLLOUT, 0};
  return ::poll(&writable, 1, static_cast<int>(std::max<long>(timeout.count(), 0))) == 1;
}

// Of ECMA-48 terminals: erases from the cursor to the end of the line.
constexpr std::string_view kEraseToEnd = "\033[K";
constexpr std::string_view kEraseLine = "\r\033[K";

// The text in less columns than the terminal has: the cursor stays in the line.
std::string fit_to_terminal(std::string_view text, int fd) {
  std::size_t columns = terminal_columns(fd);
  std::string fitted;
  for (const char c : text) {
    const bool begins_character = (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    if (begins_character && --columns == 0) {
      break;
    }
    fitted += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  }
  return fitted;
}

std::size_t count_lines(std::string_view text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

Screen::Screen(int fd, EventLoop* loop, Limits limits) : loop_(loop), limits_(limits), fd_(fd) {
  struct stat status {};
  if (::fstat(fd, &status) != 0) {
    return;  // the first write tells that it is gone
  }
  terminal_ = takes_control_sequences(fd);
  if (S_ISSOCK(status.st_mode)) {
    kind_ = Kind::kSocket;
  } else if (S_ISFIFO(status.st_mode) || ::isatty(fd) != 0) {
    // It may belong to another user (after su), or to a terminal that this container does not have.
    const std::string path = "/proc/self/fd/" + std::to_string(fd);
    own_.reset(::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    kind_ = own_ ? Kind::kOwnDescription : Kind::kSharedDescription;
    fd_ = own_ ? own_.get() : fd;
  }
}

bool Screen::print(std::string_view lines, bool logged) {
  if (gone_) {
    return false;
  }
  if (stalled_ || loop_ == nullptr) {
    write_queue();
  }
  if (stalled_ || !make_room(lines.size())) {
    stalled_ = true;
    dropped_ += count_lines(lines);
    return false;
  }
  erase_status();
  put(lines, logged);
  draw_status();
  return !gone_;
}

void Screen::put(std::string_view bytes, bool logged) {
  if (queue_.empty()) {
    while (!bytes.empty()) {
      const std::size_t written = write_some(bytes);
      if (written == 0) {
        break;
      }
      bytes.remove_prefix(written);
    }
  }
  if (!gone_ && !bytes.empty()) {
    append(bytes, logged);
    watch();
  }
}

void Screen::show_status(std::string_view text) {
  if (!terminal_ || gone_ || text == status_) {
    return;
  }
  status_ = text;
  if (status_.empty()) {
    erase_status();
  }
  draw_status();
}

void Screen::erase_status() {
  if (std::exchange(status_shown_, false)) {
    put(kEraseLine, true);
  }
}

void Screen::draw_status() {
  if (gone_ || status_.empty() || !queue_.empty()) {
    return;
  }
  const pid_t foreground = ::tcgetpgrp(fd_);  // -1 for a terminal that is not ours
  if (foreground >= 0 && foreground != ::getpgrp()) {
    return;
  }
  status_shown_ = true;
  put(std::string("\r").append(fit_to_terminal(status_, fd_)).append(kEraseToEnd), true);
}

Screen::Rest Screen::finish() {
  show_status("");
  Clock::time_point last_progress = Clock::now();
  while (!queue_.empty() && !gone_) {
    const std::size_t before = waiting_;
    write_queue();
    if (waiting_ != before) {
      last_progress = Clock::now();
      continue;
    }
    const auto left = last_progress + limits_.wait_at_the_end - Clock::now();
    if (left <= Clock::duration::zero()) {
      break;
    }
    is_writable(fd_, std::chrono::ceil<std::chrono::milliseconds>(left));
  }
  source_.reset();
  Rest rest;
  for (const Chunk& chunk : queue_) {
    const std::string_view text = std::string_view(chunk.text).substr(std::exchange(written_, 0));
    rest.lines += count_lines(text);
    if (!chunk.logged) {
      rest.unlogged += text;
    }
  }
  rest.lines += std::exchange(dropped_, 0);
  queue_.clear();
  waiting_ = 0;
  gone_ = true;
  return rest;
}

std::size_t Screen::write_some(std::string_view bytes) {
  while (true) {
    if (kind_ == Kind::kSharedDescription && !is_writable(fd_, std::chrono::milliseconds{0})) {
      return 0;
    }
    const std::size_t size = kind_ == Kind::kSharedDescription ? std::min(bytes.size(), kNeverWaits) : bytes.size();
    const ssize_t written = kind_ == Kind::kSocket ? ::send(fd_, bytes.data(), size, MSG_DONTWAIT | MSG_NOSIGNAL)
                                                   : ::write(fd_, bytes.data(), size);
    if (written >= 0) {
      return static_cast<std::size_t>(written);
    }
    if (errno == EAGAIN) {
      return 0;
    }
    if (errno != EINTR) {
      gone_ = true;
      return 0;
    }
  }
}

void Screen::append(std::string_view lines, bool logged) {
  waiting_ += lines.size();
  if (queue_.empty() || queue_.back().logged != logged || queue_.back().text.size() + lines.size() > kChunk) {
    queue_.push_back({std::string(lines), logged});
  } else {
    queue_.back().text.append(lines);
  }
}

// Waits for room in a full queue. A reader that reads makes some soon.
bool Screen::make_room(std::size_t size) {
  if (waiting_ == 0 || waiting_ + size <= limits_.queue) {
    return true;
  }
  const Clock::time_point end = Clock::now() + limits_.wait_for_room;
  while (true) {
    write_queue();
    if (gone_ || waiting_ == 0 || waiting_ + size <= limits_.queue) {
      return !gone_;
    }
    const auto left = end - Clock::now();
    if (left <= Clock::duration::zero()) {
      return false;
    }
    is_writable(fd_, std::chrono::ceil<std::chrono::milliseconds>(left));
  }
}

void Screen::write_queue() {
  while (!queue_.empty()) {
    const std::string& first = queue_.front().text;
    const std::size_t written = write_some(std::string_view(first).substr(written_));
    written_ += written;
    waiting_ -= written;
    if (written_ < first.size()) {
      break;
    }
    queue_.pop_front();
    written_ = 0;
  }
  if (stalled_ && waiting_ <= limits_.queue / 2) {
    resume();
  }
  watch();
  if (!status_shown_) {
    draw_status();
  }
}

void Screen::resume() {
  stalled_ = false;
  if (const std::size_t lines = std::exchange(dropped_, 0); lines > 0 && notice_) {
    append(notice_(lines), true);
  }
}

void Screen::watch() {
  if (gone_ || queue_.empty()) {
    source_.reset();
  } else if (loop_ != nullptr && !source_) {
    source_ = loop_->on_writable(fd_, [this] { write_queue(); });
  }
}

}  // namespace launch
