// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/line_program.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace launch {
namespace {

constexpr std::chrono::milliseconds kWriteAgain{10};  // to a program that does not read

std::string how_program_ended(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("was ended by SIG{}", ::sigabbrev_np(WTERMSIG(status)));
  }
  return fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

}  // namespace

LineProgram::~LineProgram() {
  close();
  if (pid_ > 0) {
    reap();
  }
}

void LineProgram::start(ChildProgram child, Observer observer) {
  observer_ = std::move(observer);
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::system_error(errno, std::system_category(), "cannot create a socket for " + child.argv.front());
  }
  UniqueFd ours(ends[0]);
  const UniqueFd other(ends[1]);
  for (ChildDescriptor& descriptor : child.descriptors) {
    if (descriptor.source == kSocket) {
      descriptor.source = other.get();
    }
  }
  child.group = ChildGroup::kOwnSession;
  child.signals = ChildSignals::kFresh;
  pid_ = spawn(child);
  socket_ = std::move(ours);
  readable_ = loop_.on_readable(socket_.get(), [this] { on_readable(); });
}

void LineProgram::close() {
  readable_.reset();
  retry_.reset();
  socket_.reset();
}

void LineProgram::write(const std::string& line) {
  unwritten_ += line;
  if (!retry_) {
    flush();
  }
}

// on_readable() notices a program that has ended.
void LineProgram::flush() {
  retry_.reset();
  while (!unwritten_.empty()) {
    const ssize_t count = ::send(socket_.get(), unwritten_.data(), unwritten_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0) {
      if (errno == EAGAIN || errno == EWOULDBLOCK) {
        retry_ = loop_.after(kWriteAgain, [this] { flush(); });
      }
      return;
    }
    unwritten_.erase(0, static_cast<std::size_t>(count));
  }
}

void LineProgram::on_readable() {
  const auto self = shared_from_this();  // what a line leads to may let go of this
  std::array<char, 4096> buffer{};
  const ssize_t count = ::recv(socket_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
    return;
  }
  if (count <= 0) {
    close();
    observer_.end(how_program_ended(reap()));
    return;
  }
  unread_.append(buffer.data(), static_cast<std::size_t>(count));
  for (std::size_t end; is_open() && (end = unread_.find('\n')) != std::string::npos;) {
    const std::string line = unread_.substr(0, end);
    unread_.erase(0, end + 1);
    observer_.line(line);
  }
}

int LineProgram::reap() {
  if (!ends_within(pid_, longest_end_)) {
    ::kill(pid_, SIGKILL);
  }
  const int status = wait_for(pid_);
  pid_ = -1;
  return status;
}

}  // namespace launch
