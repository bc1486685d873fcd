// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/guardian.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/environment/own_prefix.hpp"
#include "base/files/pipe.hpp"
#include "base/processes/process_mark.hpp"
#include "base/processes/spawn.hpp"
#include "launcher/process/guardian/guardian_protocol.hpp"
#include "launcher/process/guardian/process_scan.hpp"

namespace launch {

namespace {

[[noreturn]] void throw_error(const char* what) {
  throw std::system_error(errno, std::system_category(), what);
}

std::string random_id() {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, 0) != sizeof number) {
    throw_error("cannot get a random number");
  }
  return fmt::format("{:016x}", number);
}

// A program can have children before its first instruction, when a shell has become the program by exec. They are none
// of ours.
std::string earlier_children() {
  siginfo_t info{};
  if (::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) != 0) {
    return "";
  }
  std::ifstream file(fmt::format("/proc/self/task/{}/children", ::getpid()));
  std::string all;
  for (std::string child; file >> child;) {
    all += child + ",";
  }
  return all;
}

[[noreturn]] void become(const std::string& program, const std::vector<std::string>& words, pid_t launcher) {
  std::vector<char*> argv;
  for (const std::string& word : words) {
    argv.push_back(const_cast<char*>(word.c_str()));  // exec does not write, C has no way to say so
  }
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
  const int error = errno;
  ::kill(launcher, SIGKILL);
  ::waitpid(launcher, nullptr, 0);
  fmt::print(stderr, "launch: error: cannot start '{}': {}\n", program, std::strerror(error));
  std::fflush(stderr);
  ::_exit(EXIT_FAILURE);
}

void write_record(int file, GuardianRecord::Kind kind, std::int32_t id, std::string_view rest = {}) {
  GuardianRecord record{kind, id, static_cast<std::uint32_t>(rest.size())};
  const std::array<iovec, 2> parts{iovec{&record, sizeof record}, iovec{const_cast<char*>(rest.data()), rest.size()}};
  if (::writev(file, parts.data(), parts.size()) != static_cast<ssize_t>(sizeof record + rest.size())) {
    throw_error("cannot tell launch-guardian what to clean up");
  }
}

std::int64_t milliseconds(Duration duration) {
  return std::chrono::ceil<std::chrono::milliseconds>(duration).count();
}

}  // namespace

Guardian Guardian::put_above(const std::vector<std::string>& command_line, const std::string& program,
                             const std::vector<int>& held) {
  const UniqueFd file(::memfd_create("launch-guardian", MFD_CLOEXEC));
  // The number of a standard descriptor is free when that descriptor was closed.
  UniqueFd records(file ? ::fcntl(file.get(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1) : -1);
  if (!records) {
    throw_error("cannot create a memory file for launch-guardian");
  }
  Pipe ready = make_pipe();
  const std::string id = random_id();
  // An ignored SIGCHLD would let the kernel reap children, and nobody would know how they ended.
  ::signal(SIGCHLD, SIG_DFL);
  const std::string children = earlier_children();
  if (::prctl(PR_SET_CHILD_SUBREAPER, 1) != 0) {
    throw_error("cannot become the parent of orphans");
  }
  // The guardian reads signals from a descriptor. Until then they wait.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  ::sigprocmask(SIG_BLOCK, &all, &before);
  const pid_t guardian = ::getpid();
  const pid_t launcher = ::fork();
  if (launcher < 0) {
    throw_error("cannot start a process");
  }
  if (launcher > 0) {
    std::vector<std::string> words{"launch-guardian",
                                   id,
                                   std::to_string(launcher),
                                   std::to_string(records.get()),
                                   std::to_string(ready.write.get()),
                                   children,
                                   "--"};
    words.insert(words.end(), command_line.begin(), command_line.end());
    ::fcntl(records.get(), F_SETFD, 0);
    ::fcntl(ready.write.get(), F_SETFD, 0);
    for (const int descriptor : held) {
      ::fcntl(descriptor, F_SETFD, 0);
    }
    become(program, words, launcher);
  }
  if (::prctl(PR_SET_PDEATHSIG, SIGTERM) != 0 || ::getppid() != guardian) {
    ::_exit(EXIT_FAILURE);
  }
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
  return {std::move(records), std::move(ready.read), id, guardian, program, ::getpid()};
}

Guardian::~Guardian() {
  if (!records_ || ::getpid() != launcher_ || is_alive() || has_spare()) {
    return;
  }
  ::unsetenv(kMarkVariable);  // or else it would take itself for a process of the launch
  try {
    spawn({.program = program_,
           .argv = {"launch-guardian", id_, std::to_string(launcher_), std::to_string(records_.get()), "-1", "",
                    "--after"},
           .descriptors = {{records_.get(), records_.get()}},
           .only_given_descriptors = true,
           .signals = ChildSignals::kAllBlocked});
  } catch (const std::system_error&) {
    // Nothing else can be done.
  }
}

bool Guardian::has_spare() const {
  const std::string argument = '\0' + id_ + '\0';
  const std::vector<FoundProcess> all = all_processes();
  return std::any_of(all.begin(), all.end(), [&](const FoundProcess& process) {
    if (process.name != "guardian-spare" ||
        read_proc_file(process.pid, "cmdline").find(argument) == std::string::npos || is_being_killed(process.pid)) {
      return false;
    }
    // A process that takes SIGKILL has it no longer, and begins to exit.
    const std::optional<FoundProcess> now = read_process(process.pid);
    return now && !now->is_dead() && !now->dying;
  });
}

void Guardian::wait_until_ready() {
  if (ready_) {
    read_to_end(ready_);
    ready_.reset();
  }
}

bool Guardian::is_alive() const {
  return ::getppid() == pid_;
}

std::string Guardian::mark(const std::string& label, const ProcessSpec& spec) const {
  return fmt::format("{}={}:{}:{}:{}{}:{}", kMarkVariable, id_, milliseconds(spec.sigterm_timeout),
                     milliseconds(spec.sigkill_timeout), spec.output.out.screen ? "o" : "",
                     spec.output.err.screen ? "e" : "", label);
}

void Guardian::set_log(const std::string& path) {
  write_record(records_.get(), GuardianRecord::Kind::kLog, 0, path);
}

std::int32_t Guardian::add_clean_up(const std::vector<std::string>& command) {
  std::string words;
  for (const std::string& word : command) {
    words += word;
    words += '\0';
  }
  write_record(records_.get(), GuardianRecord::Kind::kAddCleanUp, ++clean_ups_, words);
  return clean_ups_;
}

void Guardian::remove_clean_up(std::int32_t number) {
  write_record(records_.get(), GuardianRecord::Kind::kRemoveCleanUp, number);
}

std::string Guardian::default_program() {
  return own_library_file("launch-guardian");
}

std::vector<std::string> left_behind(const std::string& screen) {
  std::vector<std::string> messages;
  std::istringstream lines(screen);
  for (std::string line; std::getline(lines, line);) {
    for (const std::string_view begin : {"[WARNING] [launch]: ", "[ERROR] [launch]: "}) {
      if (!line.starts_with(begin)) {
        continue;
      }
      line.erase(0, begin.size());
      for (const std::string_view end : {"; ending it", "; ending them"}) {
        if (line.ends_with(end) && line.find(" running: ") != std::string::npos) {
          messages.push_back(line.substr(0, line.size() - end.size()));
        }
      }
      if (line.starts_with("cannot end ")) {
        messages.push_back(line);
      }
      break;
    }
  }
  return messages;
}

}  // namespace launch
