// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/guardian.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "launcher/process/guardian/guardian_protocol.hpp"

namespace launch {
namespace {

void send_record(int socket, GuardianRecord::Kind kind, std::int32_t id, const std::string& rest = {}) {
  GuardianRecord record{kind, id};
  const std::array<iovec, 2> parts{iovec{&record, sizeof record}, iovec{const_cast<char*>(rest.data()), rest.size()}};
  msghdr message{};
  message.msg_iov = const_cast<iovec*>(parts.data());
  message.msg_iovlen = parts.size();
  // Not waiting: a helper that hangs must not stop the launcher.
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

  std::string name = "launch-guardian";
  std::string milliseconds = std::to_string(std::chrono::ceil<std::chrono::milliseconds>(grace).count());
  const std::array<char*, 3> argv{name.data(), milliseconds.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, other.get(), STDIN_FILENO);
  // Whoever reads the launcher's output through a pipe must not wait for the helper.
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addchdir_np(&actions, "/");
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigfillset(&signals);  // until it ignores those that it shall survive
  posix_spawnattr_setsigmask(&attributes, &signals);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
  const int error = ::posix_spawn(&pid_, program.c_str(), &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw std::system_error(error, std::system_category(), fmt::format("cannot start '{}'", program));
  }
}

Guardian::~Guardian() {
  socket_.reset();
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
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
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  return (self.parent_path().parent_path() / "lib/launch/launch-guardian").string();
}

Process GuardedProcessRunner::spawn(const ProcessSpec& spec) {
  Process process = runner_.spawn(spec);
  guardian_.attach(process.pid);
  return process;
}

ProcessExit GuardedProcessRunner::reap(const Process& process) {
  // Before the process is reaped: afterwards the number may belong to somebody else.
  guardian_.detach(process.pid);
  return runner_.reap(process);
}

}  // namespace launch
