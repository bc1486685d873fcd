// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/clean_ups.hpp"

#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string_view>

#include "base/files/unique_fd.hpp"
#include "base/processes/ending_signals.hpp"
#include "launcher/process/guardian/guardian_protocol.hpp"

namespace launch {
namespace {

// A command that hangs must not block the guardian, and everything that waits for it, for ever.
constexpr std::chrono::seconds kLimit{10};

std::string read_whole(int file) {
  std::string text;
  std::array<char, 4096> buffer;  // not initialised: it is read into
  for (ssize_t count = 0; (count = ::pread(file, buffer.data(), buffer.size(), static_cast<off_t>(text.size()))) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return text;
}

std::vector<std::string> split_words(std::string_view bytes) {
  std::vector<std::string> words;
  for (std::size_t end; (end = bytes.find('\0')) != std::string_view::npos; bytes.remove_prefix(end + 1)) {
    words.emplace_back(bytes.substr(0, end));
  }
  return words;
}

// Returns 0 or the error number.
int start(const std::vector<std::string>& command, pid_t& pid) {
  std::vector<char*> argv;
  for (const std::string& word : command) {
    argv.push_back(const_cast<char*>(word.c_str()));  // exec does not write, C has no way to say so
  }
  argv.push_back(nullptr);
  // The guardian has blocked its signals; a program expects none to be blocked or ignored.
  sigset_t signals;
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigemptyset(&signals);
  ::posix_spawnattr_setsigmask(&attributes, &signals);
  sigfillset(&signals);
  ::posix_spawnattr_setsigdefault(&attributes, &signals);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  const int error = ::posix_spawn(&pid, argv[0], nullptr, &attributes, argv.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  return error;
}

// Whether a user has asked to end.
bool is_asked_to_end(int signals) {
  bool asked = false;
  for (signalfd_siginfo info{}; ::read(signals, &info, sizeof info) == sizeof info;) {
    asked = asked || asks_to_end(static_cast<int>(info.ssi_signo));
  }
  return asked;
}

// Whether the process ends in time.
bool ends_in_time(int process, int signals) {
  const auto end = std::chrono::steady_clock::now() + kLimit;
  std::array<pollfd, 2> descriptors{{{process, POLLIN, 0}, {signals, POLLIN, 0}}};  // poll(2) skips a negative one
  while ((descriptors[0].revents & POLLIN) == 0) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now()).count();
    if (left <= 0 || (descriptors[1].revents != 0 && is_asked_to_end(signals))) {
      return false;
    }
    ::poll(descriptors.data(), descriptors.size(), static_cast<int>(left));
  }
  return true;
}

}  // namespace

LeftWork read_records(int file) {
  LeftWork work;
  const std::string text = read_whole(file);
  GuardianRecord record{};
  for (std::string_view rest = text; rest.size() >= sizeof record;) {
    std::memcpy(&record, rest.data(), sizeof record);
    rest.remove_prefix(sizeof record);
    if (rest.size() < record.size) {
      break;  // the launcher was killed while it wrote
    }
    const std::string_view content = rest.substr(0, record.size);
    rest.remove_prefix(record.size);
    switch (record.kind) {
      case GuardianRecord::Kind::kAddCleanUp:
        work.clean_ups[record.id] = split_words(content);
        break;
      case GuardianRecord::Kind::kRemoveCleanUp:
        work.clean_ups.erase(record.id);
        break;
      case GuardianRecord::Kind::kLog:
        work.log = content;
        break;
    }
  }
  return work;
}

std::string run_clean_up(const std::vector<std::string>& command, int signals) {
  if (command.empty()) {
    return "";
  }
  pid_t pid = -1;
  if (const int error = start(command, pid)) {
    return "cannot run " + command.front() + ": " + std::strerror(error);
  }
  const UniqueFd pidfd(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
  std::string failure;
  if (!ends_in_time(pidfd.get(), signals)) {
    failure = "'";
    for (const std::string& word : command) {
      failure += (failure.size() == 1 ? "" : " ") + word;
    }
    failure += "' takes too long: killing it";
    ::kill(pid, SIGKILL);
  }
  ::waitpid(pid, nullptr, 0);
  return failure;
}

}  // namespace launch
