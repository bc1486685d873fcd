// SPDX-License-Identifier: Apache-2.0
#include "launcher/conditions/condition_watch_process.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "base/environment/own_prefix.hpp"
#include "base/processes/spawn.hpp"

namespace launch {
namespace {

constexpr const char* kWatchProgram = "launch-watch";
// A recording ends within tenths of a second, unless the session daemon does not answer.
constexpr std::chrono::milliseconds kLongestEndOfRecording{15'000};
constexpr std::chrono::milliseconds kWriteAgain{10};
constexpr int kMostRestarts = 5;
constexpr std::chrono::seconds kBeforeRestart{1};  // and twice as long each time

std::string how_watch_ended(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("launch-watch was ended by SIG{}", sigabbrev_np(WTERMSIG(status)));
  }
  return fmt::format("launch-watch ended with exit code {}", WEXITSTATUS(status));
}

}  // namespace

ConditionWatchProcess::ConditionWatchProcess(EventLoop& loop, std::string launch, std::string program)
    : loop_(loop), launch_(std::move(launch)), program_(std::move(program)) {}

ConditionWatchProcess::~ConditionWatchProcess() {
  close();
  if (pid_ > 0) {
    reap();
  }
}

void ConditionWatchProcess::watch(tracing::ConditionId id, const tracing::LiveCondition& condition) {
  watched_.insert_or_assign(id, condition);
  if (again_) {
    return;  // it is among those of the next start
  }
  if (!socket_) {
    start();
  } else {
    write(to_line(tracing::ConditionOrder(tracing::WatchCondition{id, condition})));
  }
}

void ConditionWatchProcess::forget(tracing::ConditionId id) {
  if (watched_.erase(id) != 0 && socket_) {
    write(to_line(tracing::ConditionOrder(tracing::ForgetCondition{id})));
  }
}

void ConditionWatchProcess::close() {
  again_.reset();
  readable_.reset();
  retry_.reset();
  socket_.reset();
  watched_.clear();
}

void ConditionWatchProcess::start() {
  again_.reset();
  unwritten_.clear();
  unread_.clear();
  has_failed_ = false;
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return fail(fmt::format("no socket for launch-watch: {}", ::strerror(errno)), "");
  }
  socket_.reset(ends[0]);
  const UniqueFd other(ends[1]);
  try {
    const std::string program = program_.empty() ? own_library_file(kWatchProgram) : program_;
    pid_ = spawn({.program = program,
                  .argv = {kWatchProgram, "--conditions", launch_},
                  .descriptors = {{STDIN_FILENO, other.get()}, {STDOUT_FILENO, other.get()}, {STDERR_FILENO, kDevNull}},
                  .group = ChildGroup::kOwnSession,
                  .signals = ChildSignals::kFresh});
  } catch (const std::system_error& error) {
    socket_.reset();
    return fail(error.what(), "");
  }
  readable_ = loop_.on_readable(socket_.get(), [this] { on_readable(); });
  for (const auto& [id, condition] : watched_) {
    write(to_line(tracing::ConditionOrder(tracing::WatchCondition{id, condition})));
  }
}

void ConditionWatchProcess::write(const std::string& line) {
  unwritten_ += line;
  if (!retry_) {
    flush();
  }
}

// Never waits. on_readable() notices a program that has ended.
void ConditionWatchProcess::flush() {
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

void ConditionWatchProcess::on_readable() {
  std::array<char, 4096> buffer{};
  const ssize_t count = ::recv(socket_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
    return;
  }
  if (count <= 0) {
    return lose();
  }
  unread_.append(buffer.data(), static_cast<std::size_t>(count));
  for (std::size_t end; socket_ && (end = unread_.find('\n')) != std::string::npos;) {
    const std::string line = unread_.substr(0, end);
    unread_.erase(0, end + 1);
    on_line(line);
  }
}

void ConditionWatchProcess::on_line(std::string_view line) {
  tracing::ConditionReport report;
  try {
    report = tracing::parse_condition_report(line);
  } catch (const std::runtime_error&) {
    return;  // of another version
  }
  if (const auto* const failed = std::get_if<tracing::WatchFailed>(&report)) {
    has_failed_ = true;
    return fail(failed->error, failed->help);
  }
  has_recorded_ |= std::holds_alternative<tracing::NodesAreRecorded>(report);
  tell_(report);
}

void ConditionWatchProcess::lose() {
  readable_.reset();
  retry_.reset();
  socket_.reset();
  const std::string how = how_watch_ended(reap());
  if (!has_failed_) {
    fail(how, "");
  }
}

// A program that has recorded is started again: what has ended it may be over.
void ConditionWatchProcess::fail(const std::string& error, const std::string& help) {
  readable_.reset();
  retry_.reset();
  socket_.reset();
  const bool goes_on = has_recorded_ && restarts_ < kMostRestarts;
  if (goes_on) {
    again_ = loop_.after(kBeforeRestart * (1 << restarts_++), [this] {
      if (pid_ > 0) {
        reap();
      }
      start();
    });
  }
  loop_.post([this, error, help, goes_on] { tell_(tracing::WatchFailed{error, help, goes_on}); });
}

int ConditionWatchProcess::reap() {
  if (!ends_within(pid_, kLongestEndOfRecording)) {
    ::kill(pid_, SIGKILL);
  }
  const int status = wait_for(pid_);
  pid_ = -1;
  return status;
}

}  // namespace launch
