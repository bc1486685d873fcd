// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/guardian.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
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
#include <string_view>
#include <system_error>
#include <utility>

#include "base/environment/own_prefix.hpp"
#include "base/files/pipe.hpp"
#include "base/processes/process_mark.hpp"
#include "base/processes/spawn.hpp"
#include "launcher/process/guardian/become_guardian.hpp"
#include "launcher/process/guardian/guardian_protocol.hpp"
#include "launcher/process/guardian/inherited_mark.hpp"
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

// The launcher has lost a guardian. As long as the other one lives, it is the parent. Who has lost both learns it here
// a moment before their descriptors tell it.
volatile sig_atomic_t guardian_of_launcher = -1;
volatile sig_atomic_t has_lost_both = 0;
void on_lost_guardian(int) {
  if (::getppid() != guardian_of_launcher) {
    has_lost_both = 1;
    ::kill(::getpid(), SIGTERM);
  }
}

[[noreturn]] void refuse(const char* call, const char* since) {
  const int error = errno;
  throw std::system_error(error, std::system_category(),
                          fmt::format("the system call {} does not work here, and no launch can run without it (Linux "
                                      "has it since {}; a seccomp profile may forbid it)",
                                      call, since));
}

// The calls without which a launch could not wait for its processes, or its guardian for signals. Returns a descriptor
// of this process.
UniqueFd check_system_calls() {
  UniqueFd process(static_cast<int>(::syscall(SYS_pidfd_open, ::getpid(), 0)));
  if (!process) {
    refuse("pidfd_open", "5.3");
  }
  siginfo_t info{};
  if (::syscall(SYS_waitid, P_PIDFD, process.get(), &info, WEXITED | WNOHANG, nullptr) != 0 && errno != ECHILD) {
    refuse("waitid with P_PIDFD", "5.4");
  }
  if (::syscall(SYS_pidfd_send_signal, process.get(), 0, nullptr, 0) != 0) {
    refuse("pidfd_send_signal", "5.1");
  }
  sigset_t none;
  sigemptyset(&none);
  if (const UniqueFd signals(::signalfd(-1, &none, SFD_CLOEXEC)); !signals) {
    refuse("signalfd4", "2.6.27");
  }
  return process;
}

[[noreturn]] void fail_to_become(const std::string& program, pid_t spare, pid_t launcher) {
  const int error = errno;
  ::kill(spare, SIGKILL);
  ::kill(launcher, SIGKILL);
  ::waitpid(spare, nullptr, 0);
  ::waitpid(launcher, nullptr, 0);  // it has been adopted
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
                             const std::vector<int>& held, UniqueFd records) {
  UniqueFd process = check_system_calls();
  if (!records) {
    records = make_guardian_records();
  }
  Pipe ready = make_pipe();
  Pipe born = make_pipe();
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
  std::vector<int> inherited = held;
  inherited.insert(inherited.end(), {records.get(), ready.write.get()});
  const auto words_of = [&](pid_t launcher, pid_t other, const char* role) {
    return std::vector<std::string>{"launch-guardian",
                                    id,
                                    std::to_string(launcher),
                                    std::to_string(other),
                                    std::to_string(records.get()),
                                    std::to_string(ready.write.get()),
                                    children,
                                    role};
  };
  const pid_t guardian = ::getpid();
  // The spare keeps nothing of this memory, so only the launcher needs a copy of it. This process goes on when the
  // spare has become another program.
  const pid_t spare = ::vfork();
  if (spare < 0) {
    const int error = errno;
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    errno = error;
    throw_error("cannot start a process");
  }
  if (spare > 0) {
    born.write.reset();
    pid_t launcher = -1;
    if (::read(born.read.get(), &launcher, sizeof launcher) != sizeof launcher) {
      ::waitpid(spare, nullptr, 0);
      ::sigprocmask(SIG_SETMASK, &before, nullptr);
      errno = EAGAIN;
      throw_error("cannot start a process");
    }
    std::vector<std::string> words = words_of(launcher, spare, "--");
    words.insert(words.end(), command_line.begin(), command_line.end());
    become_guardian(program, words, inherited);
    fail_to_become(program, spare, launcher);
  }
  if (::prctl(PR_SET_CHILD_SUBREAPER, 1) != 0) {
    ::_exit(EXIT_FAILURE);
  }
  const pid_t parent = ::getpid();
  const pid_t launcher = ::fork();
  if (launcher < 0) {
    ::_exit(EXIT_FAILURE);
  }
  if (launcher > 0) {
    static_cast<void>(!::write(born.write.get(), &launcher, sizeof launcher));
    become_guardian(program, words_of(launcher, guardian, "--between"), inherited);
    ::_exit(EXIT_FAILURE);  // the guardian says what is wrong with the program
  }
  guardian_of_launcher = guardian;
  const std::uint64_t mark = InheritedMark::give_to_this_process(id).value();
  if (::pwrite(records.get(), &mark, sizeof mark, kGuardianMark) != sizeof mark) {
    ::_exit(EXIT_FAILURE);
  }
  struct sigaction action {};
  action.sa_handler = on_lost_guardian;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGURG, &action, nullptr);
  sigdelset(&before, SIGURG);
  if (::prctl(PR_SET_PDEATHSIG, SIGURG) != 0 || ::getppid() != parent) {
    ::_exit(EXIT_FAILURE);
  }
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
  return {std::move(records), std::move(ready.read), std::move(process), id, guardian, program, ::getpid()};
}

Guardian::~Guardian() {
  if (!records_ || ::getpid() != launcher_ || is_alive() || has_spare()) {
    return;
  }
  ::unsetenv(kMarkVariable);  // or else it would take itself for a process of the launch
  try {
    spawn({.program = program_,
           .argv = {"launch-guardian", id_, std::to_string(launcher_), "-1", std::to_string(records_.get()), "-1", "",
                    "--after"},
           .descriptors = {{records_.get(), records_.get()}},
           .only_given_descriptors = true,
           .signals = ChildSignals::kAllBlocked});
  } catch (const std::system_error&) {
    // Nothing else can be done.
  }
}

bool Guardian::has_spare() const {
  const std::vector<FoundProcess> all = all_processes();
  return std::any_of(all.begin(), all.end(), [&](const FoundProcess& process) {
    if (!is_guardian(process, id_) || is_being_killed(process.pid)) {
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
  pollfd ended{process_.get(), POLLIN, 0};
  return has_lost_both == 0 && ::poll(&ended, 1, 0) == 0;
}

void Guardian::note(std::size_t number, pid_t pid, const std::string& label, const ProcessSpec& spec) {
  if (number == 0 || number > kGuardianEntries) {
    return;
  }
  GuardianEntry entry{};
  entry.pid = pid;
  entry.on_screen = static_cast<char>((spec.output.out.screen ? 1 : 0) + (spec.output.err.screen ? 2 : 0));
  label.copy(entry.label, sizeof entry.label - 1);
  entry.sigterm_timeout = milliseconds(spec.sigterm_timeout);
  entry.sigkill_timeout = milliseconds(spec.sigkill_timeout);
  // Without the note, the process is found all the same.
  static_cast<void>(!::pwrite(records_.get(), &entry, sizeof entry, static_cast<off_t>((number - 1) * sizeof entry)));
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

PythonAtWork* Guardian::python_at_work() const {
  void* const memory =
      ::mmap(nullptr, sizeof(PythonAtWork), PROT_READ | PROT_WRITE, MAP_SHARED, records_.get(), kGuardianPython);
  return memory == MAP_FAILED ? nullptr : static_cast<PythonAtWork*>(memory);
}

UniqueFd Guardian::python_traces() const {
  // A descriptor with a place of its own in the file.
  UniqueFd traces(::open(fmt::format("/proc/self/fd/{}", records_.get()).c_str(), O_WRONLY | O_CLOEXEC));
  if (traces && ::lseek(traces.get(), kGuardianPythonTraces, SEEK_SET) != kGuardianPythonTraces) {
    traces.reset();
  }
  return traces;
}

std::string Guardian::default_program() {
  return own_library_file("launch-guardian");
}

}  // namespace launch
