// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/guardian.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "launcher/base/own_prefix.hpp"
#include "launcher/base/spawn.hpp"
#include "launcher/process/guardian/guardian_protocol.hpp"

namespace launch {
namespace {

void send_record(int socket, GuardianRecord::Kind kind, std::int32_t id, const std::string& rest = {}) {
  GuardianRecord record{kind, id};
  const std::array<iovec, 2> parts{iovec{&record, sizeof record}, iovec{const_cast<char*>(rest.data()), rest.size()}};
  msghdr message{};
  message.msg_iov = const_cast<iovec*>(parts.data());
  message.msg_iovlen = parts.size();
  // Does not wait: a helper that hangs must not stop the launcher.
  static_cast<void>(::sendmsg(socket, &message, MSG_NOSIGNAL | MSG_DONTWAIT));
}

}  // namespace

Guardian::Guardian(const std::string& program, Duration grace) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::system_error(errno, std::system_category(), "cannot create a socket for launch-guardian");
  }
  socket_.reset(ends[0]);
  const UniqueFd other(ends[1]);

  pid_ = spawn({
      .program = program,
      .argv = {"launch-guardian", std::to_string(std::chrono::ceil<std::chrono::milliseconds>(grace).count())},
      .directory = "/",
      // The helper does not keep the launcher's output open: a reader at the end of a pipe would wait for the helper,
      // too.
      .descriptors = {{STDIN_FILENO, other.get()}, {STDOUT_FILENO, kDevNull}},
      .group = ChildGroup::kOwnSession,
      .signals = ChildSignals::kAllBlocked,
  });
}

Guardian::~Guardian() {
  socket_.reset();
  wait_for(pid_);
}

void Guardian::attach(pid_t group) {
  send_record(socket_.get(), GuardianRecord::Kind::kAttach, group);
}

void Guardian::detach(pid_t group) {
  send_record(socket_.get(), GuardianRecord::Kind::kDetach, group);
}

std::int32_t Guardian::add_clean_up(const std::vector<std::string>& command) {
  std::string words;
  for (const std::string& word : command) {
    words += word;
    words += '\0';
  }
  if (words.size() > kLongestCleanUp) {
    throw std::system_error(E2BIG, std::system_category(), fmt::format("cannot guard '{}'", command.front()));
  }
  send_record(socket_.get(), GuardianRecord::Kind::kAddCleanUp, ++clean_ups_, words);
  return clean_ups_;
}

void Guardian::remove_clean_up(std::int32_t number) {
  send_record(socket_.get(), GuardianRecord::Kind::kRemoveCleanUp, number);
}

std::string Guardian::default_program() {
  return own_library_file("launch-guardian");
}

Process GuardedProcessRunner::spawn(const ProcessSpec& spec) {
  Process process = runner_.spawn(spec);
  guardian_.attach(process.pid);
  return process;
}

ProcessExit GuardedProcessRunner::reap(const Process& process) {
  // Detaches before the process is reaped: afterwards another process may get its number.
  guardian_.detach(process.pid);
  return runner_.reap(process);
}

}  // namespace launch
