// SPDX-License-Identifier: Apache-2.0
// launch-guardian GRACE_MILLISECONDS: ends what a launcher leaves behind when it is killed.
//
// Standard input is a socket to the launcher, which reports each process group that it starts and each group that it
// has ended. The socket closes when the launcher disappears, also by kill -9. Groups still known then get SIGTERM, and
// SIGKILL when their leader has ended or the grace period is over. After that the clean-up commands run, the last one
// first, except those that the launcher took back.
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "launcher/base/spawn.hpp"
#include "launcher/base/unique_fd.hpp"
#include "launcher/process/guardian/guardian_protocol.hpp"

namespace {

using Clock = std::chrono::steady_clock;
using launch::GuardianRecord;
using launch::UniqueFd;

// A command that hangs must not block this program, and everything that waits for it, for ever.
constexpr std::chrono::milliseconds kCleanUpLimit = std::chrono::seconds(10);

// The groups and commands that a launcher has left behind.
struct Remains {
  std::set<pid_t> groups;
  std::map<std::int32_t, std::vector<std::string>> clean_ups;
};

std::vector<std::string> split_words(std::string_view bytes) {
  std::vector<std::string> words;
  for (std::size_t end; (end = bytes.find('\0')) != std::string_view::npos; bytes.remove_prefix(end + 1)) {
    words.emplace_back(bytes.substr(0, end));
  }
  return words;
}

Remains follow_launcher(int socket) {
  Remains remains;
  std::array<char, sizeof(GuardianRecord) + launch::kLongestCleanUp> message{};
  while (true) {
    const ssize_t size = ::recv(socket, message.data(), message.size(), 0);
    if (size < 0 && errno == EINTR) {
      continue;
    }
    if (size < static_cast<ssize_t>(sizeof(GuardianRecord))) {
      return remains;
    }
    GuardianRecord record{};
    std::memcpy(&record, message.data(), sizeof record);
    switch (record.kind) {
      case GuardianRecord::Kind::kAttach:
        if (record.id > 1) {  // kill(2) would take a smaller number for all processes
          remains.groups.insert(record.id);
        }
        break;
      case GuardianRecord::Kind::kDetach:
        remains.groups.erase(record.id);
        break;
      case GuardianRecord::Kind::kAddCleanUp:
        remains.clean_ups[record.id] =
            split_words({message.data() + sizeof record, static_cast<std::size_t>(size) - sizeof record});
        break;
      case GuardianRecord::Kind::kRemoveCleanUp:
        remains.clean_ups.erase(record.id);
        break;
    }
  }
}

void end_groups(std::set<pid_t> groups, std::chrono::milliseconds grace) {
  std::vector<pid_t> leaders;
  std::vector<UniqueFd> pidfds;
  std::vector<pollfd> descriptors;
  for (const pid_t group : groups) {
    UniqueFd pidfd(static_cast<int>(::syscall(SYS_pidfd_open, group, 0)));
    if (pidfd) {
      descriptors.push_back({pidfd.get(), POLLIN, 0});
      pidfds.push_back(std::move(pidfd));
      leaders.push_back(group);
    }
    ::kill(-group, SIGTERM);
    ::kill(-group, SIGCONT);  // a stopped group would not see the signal
  }
  const auto deadline = Clock::now() + grace;
  std::size_t running = leaders.size();
  while (running > 0) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0 || (::poll(descriptors.data(), descriptors.size(), static_cast<int>(left)) < 0 && errno != EINTR)) {
      break;
    }
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
      if (descriptors[i].fd >= 0 && descriptors[i].revents != 0) {
        // Descendants that outlive the leader are killed at once, before the number of the group can be reused.
        ::kill(-leaders[i], SIGKILL);
        groups.erase(leaders[i]);
        descriptors[i].fd = -1;
        --running;
      }
    }
  }
  for (const pid_t group : groups) {
    ::kill(-group, SIGKILL);
  }
}

void clean_up(const std::vector<std::string>& command) {
  if (command.empty()) {
    return;
  }
  pid_t pid = -1;
  try {
    // The command would inherit the signals that this program ignores.
    pid = launch::spawn({.program = command.front(), .argv = command, .signals = launch::ChildSignals::kFresh});
  } catch (const std::system_error& error) {
    fmt::print(stderr, "launch-guardian: cannot run {}: {}\n", command.front(), error.code().message());
    return;
  }
  if (!launch::ends_within(pid, kCleanUpLimit)) {
    fmt::print(stderr, "launch-guardian: '{}' takes too long: killing it\n", fmt::join(command, " "));
    ::kill(pid, SIGKILL);
  }
  launch::wait_for(pid);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "launch-guardian is started by launch, not by hand\n");
    return EXIT_FAILURE;
  }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP}) {
    ::signal(signal, SIG_IGN);
  }
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);  // the launcher starts this program with all signals blocked
  const Remains remains = follow_launcher(STDIN_FILENO);
  if (const std::size_t count = remains.groups.size(); count != 0) {
    fmt::print(stderr, "launch-guardian: the launcher has gone and left {} process group{}: ending {}\n", count,
               count == 1 ? "" : "s", count == 1 ? "it" : "them");
    end_groups(remains.groups, std::chrono::milliseconds(std::atol(argv[1])));
  }
  for (auto command = remains.clean_ups.rbegin(); command != remains.clean_ups.rend(); ++command) {
    clean_up(command->second);
  }
  return EXIT_SUCCESS;
}
