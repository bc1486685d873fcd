// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/clean_ups.hpp"

#include <dirent.h>
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
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

#include "base/files/unique_fd.hpp"
#include "base/processes/ending_signals.hpp"
#include "launcher/process/guardian/guardian_protocol.hpp"

namespace launch {
namespace {

// A command that hangs must not block the guardian, and everything that waits for it, for ever. On a machine with much
// other work it can take its time, as long as it gets on.
constexpr std::chrono::seconds kLimit{10};  // without progress
constexpr std::chrono::minutes kLongest{2};
constexpr std::chrono::seconds kBetweenLooks{1};

std::string read_whole(int file) {
  std::string text;
  std::array<char, 4096> buffer;  // not initialised: it is read into
  for (ssize_t count = 0;
       (count = ::pread(file, buffer.data(), buffer.size(), kGuardianRecords + static_cast<off_t>(text.size()))) > 0;) {
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
  // The guardian has blocked its signals; a program expects none to be ignored. Those that ask for an end stay blocked:
  // the guardian of a launch around this one asks everything below it to end, and the command is that end.
  sigset_t signals;
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigemptyset(&signals);
  for (const int signal : kEndingSignals) {
    sigaddset(&signals, signal);
  }
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

// The nanoseconds that the process has run or has waited for a processor, /proc/PID/schedstat.
std::uint64_t time_of(pid_t pid) {
  const std::string text = read_proc_file(pid, "schedstat");
  char* next = nullptr;
  const std::uint64_t has_run = std::strtoull(text.c_str(), &next, 10);
  return has_run + std::strtoull(next, nullptr, 10);
}

bool has_socket(pid_t pid) {
  const std::string path = "/proc/" + std::to_string(pid) + "/fd";
  bool found = false;
  if (DIR* const directory = ::opendir(path.c_str())) {
    while (const dirent* const entry = ::readdir(directory)) {
      std::array<char, 16> target{};
      const ssize_t size = ::readlinkat(::dirfd(directory), entry->d_name, target.data(), target.size());
      found =
          found || (size > 0 && std::string_view(target.data(), static_cast<std::size_t>(size)).starts_with("socket:"));
    }
    ::closedir(directory);
  }
  return found;
}

// What shows that a command gets on: the time of its processes. The command that ends a trace waits at a socket for
// the daemons of LTTng, so theirs counts for it as well, also if they work for somebody else.
std::uint64_t work_done(pid_t command) {
  const std::vector<FoundProcess> all = all_processes();
  std::uint64_t time = time_of(command);
  bool waits_for_daemons = has_socket(command);
  for (const FoundProcess& process : descendants(all, {command})) {
    time += time_of(process.pid);
    waits_for_daemons = waits_for_daemons || has_socket(process.pid);
  }
  for (const FoundProcess& process : all) {
    if (waits_for_daemons && process.name.compare(0, 6, "lttng-") == 0) {
      time += time_of(process.pid);
    }
  }
  return time;
}

// Whether the process ends by itself, as it should. When a user asks for the end it is asked to hurry, as the command
// that ends a trace can. A second wish ends the wait.
bool ends_in_time(pid_t pid, int process, int signals) {
  using Clock = std::chrono::steady_clock;
  constexpr std::uint64_t kProgress = 1'000'000;  // what a sleeping process does for its timers is less in a second
  const Clock::time_point begin = Clock::now();
  Clock::time_point progress = begin;
  bool hurried = false;
  std::uint64_t done = work_done(pid);
  std::array<pollfd, 2> descriptors{{{process, POLLIN, 0}, {signals, POLLIN, 0}}};  // poll(2) skips a negative one
  while (true) {
    ::poll(descriptors.data(), descriptors.size(), static_cast<int>(std::chrono::milliseconds(kBetweenLooks).count()));
    if ((descriptors[0].revents & POLLIN) != 0) {
      return true;
    }
    const Clock::time_point now = Clock::now();
    if (const std::uint64_t work = work_done(pid); work >= done + kProgress || work < done) {
      done = work;
      progress = now;
    }
    if (descriptors[1].revents != 0 && is_asked_to_end(signals)) {
      if (std::exchange(hurried, true)) {
        return false;
      }
      ::kill(pid, SIGTERM);
    }
    if (now - progress >= kLimit || now - begin >= kLongest) {
      return false;
    }
  }
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

std::map<pid_t, ProcessMark> read_notes(int file) {
  std::map<pid_t, ProcessMark> notes;
  std::array<GuardianEntry, 64> entries{};
  for (off_t begin = 0; begin < kGuardianMark; begin += static_cast<off_t>(sizeof entries)) {
    const ssize_t count = ::pread(file, entries.data(), sizeof entries, begin);
    if (count <= 0) {
      break;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(count) / sizeof(GuardianEntry); ++i) {
      if (const GuardianEntry& entry = entries[i]; entry.pid > 0) {
        notes[entry.pid] = {.ours = true,
                            .sigterm_timeout = entry.sigterm_timeout,
                            .sigkill_timeout = entry.sigkill_timeout,
                            .out_on_screen = (entry.on_screen & 1) != 0,
                            .error_on_screen = (entry.on_screen & 2) != 0,
                            .label = entry.label};
      }
    }
  }
  return notes;
}

InheritedMark read_inherited_mark(int file) {
  std::uint64_t value = 0;
  return InheritedMark(::pread(file, &value, sizeof value, kGuardianMark) == sizeof value ? value : 0);
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
  if (!ends_in_time(pid, pidfd.get(), signals)) {
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
