// SPDX-License-Identifier: Apache-2.0
// The ProcessRunner of real processes (base/processes/spawn.hpp).
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/environment/own_prefix.hpp"
#include "base/files/pipe.hpp"
#include "base/files/unique_fd.hpp"
#include "base/processes/ending_signals.hpp"
#include "base/processes/outside_number.hpp"
#include "base/processes/process_mark.hpp"
#include "base/processes/spawn.hpp"
#include "base/terminal/terminal.hpp"
#include "launcher/process/control_groups/control_group_use.hpp"
#include "launcher/process/control_groups/kernel_messages.hpp"
#include "launcher/process/exec/launch_exec_protocol.hpp"
#include "launcher/process/guardian/process_scan.hpp"
#include "launcher/process/isolation/namespaces.hpp"
#include "launcher/process/process_runner.hpp"
#include "launcher/process/spawn/child_streams.hpp"
#include "launcher/process/spawn/program_search.hpp"
#include "launcher/process/spawn/stopped_threads.hpp"

namespace launch {
namespace {

constexpr std::chrono::seconds kLongestStop(1);

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::system_category(), what);
}

// The start of a process copies the descriptors below the highest one that the process gets (spawn.hpp). So low numbers
// are left to what is about to be given.
UniqueFd out_of_the_way(UniqueFd fd) {
  constexpr int kHigh = 128;
  UniqueFd moved(fd && fd.get() < kHigh ? ::fcntl(fd.get(), F_DUPFD_CLOEXEC, kHigh) : -1);
  return moved ? std::move(moved) : std::move(fd);  // without room above, it may stay
}

std::vector<std::string> command_line(const ProcessSpec& spec) {
  if (!spec.shell) {
    return spec.argv;
  }
  std::string line;
  for (const std::string& argument : spec.argv) {
    line.append(line.empty() ? "" : " ").append(argument);
  }
  return {"/bin/sh", "-c", line};
}

// Reads what launch-exec reports before it becomes the program: nothing, when all went well.
std::optional<LaunchExecFailure> read_failure(const UniqueFd& pipe) {
  LaunchExecFailure failure{};
  ssize_t size = 0;
  do {
    size = ::read(pipe.get(), &failure, sizeof failure);
  } while (size < 0 && errno == EINTR);
  return size == sizeof failure ? std::optional(failure) : std::nullopt;
}

// A process that has the terminal shares the group of the launcher with others, perhaps programs of a shell. Its
// descendants there have its mark.
std::vector<pid_t> fellows_in_our_group(const Process& process) {
  std::vector<pid_t> found{process.pid};
  const pid_t group = ::getpgrp();
  const std::string mark = '\0' + process.mark + '\0';
  for (const FoundProcess& other : all_processes()) {
    const bool candidate = other.group == group && other.pid != process.pid && !process.mark.empty();
    if (candidate && ('\0' + read_proc_file(other.pid, "environ")).find(mark) != std::string::npos) {
      found.push_back(other.pid);
    }
  }
  return found;
}

// The process and its descendants, as far as signals get to them.
std::vector<pid_t> group_of(const Process& process) {
  if (process.has_terminal) {
    return fellows_in_our_group(process);
  }
  std::vector<pid_t> found;
  for (const FoundProcess& other : all_processes()) {
    if (other.group == process.pid && !other.is_dead()) {
      found.push_back(other.pid);
    }
  }
  return found;
}

// How many processes of a cgroup the kernel has ended for want of memory.
std::uint64_t ended_in(const std::string& control_group) {
  return read_keyed(control_group + "/memory.events", "oom_kill");
}

class PosixProcessRunner final : public ProcessRunner {
 public:
  using NamespaceChoice = std::function<const Namespaces*(const ProcessSpec&)>;

  PosixProcessRunner(std::string exec_program, NamespaceChoice namespaces_of);

  Process spawn(const ProcessSpec& spec) override;
  bool signal_group(const Process& process, int signal) override;
  std::optional<std::uint64_t> limit(const Process& process, int resource, std::uint64_t soft) override;
  std::optional<SchedulingFailure> change_scheduling(const Process& process, const ResourceLimits& wanted,
                                                     GroupScheduling& before) override {
    before.main_thread = process.pid;
    return launch::change_scheduling([&process] { return group_of(process); }, wanted, before);
  }
  std::optional<SchedulingFailure> restore_scheduling(const Process& process, const GroupScheduling& before) override {
    return launch::restore_scheduling([&process] { return group_of(process); }, before);
  }
  std::vector<bool> groups_live(const std::vector<const Process*>& leaders) override;
  std::vector<StoppedChild> take_stopped() override;
  void await_stop(const Process& process) override {
    if (process.has_terminal) {
      wait_until_stopped(fellows_in_our_group(process), kLongestStop);
    }
  }
  bool in_foreground() const override { return ::tcgetpgrp(STDIN_FILENO) == ::getpgrp(); }
  bool was_ended_by_kernel(const Process& process, Duration started) override {
    return ended_for_want_of_memory(number_outside(process.pid), started);
  }
  ProcessExit outcome(const Process& process) override { return wait(process, WNOWAIT); }
  ProcessExit reap(const Process& process) override { return wait(process, 0); }

 private:
  bool signal_fellows(const Process& process, int signal);
  ProcessExit wait(const Process& process, int flags);

  std::string exec_program_;
  NamespaceChoice namespaces_of_;
  std::optional<rlimit> limit_of_children_;  // only if it differs from the launcher's
  std::optional<TerminalState> terminal_;    // before a process got the terminal
};

PosixProcessRunner::PosixProcessRunner(std::string exec_program, NamespaceChoice namespaces_of)
    : exec_program_(std::move(exec_program)), namespaces_of_(std::move(namespaces_of)) {
  for (int fd = 0; fd <= 2; ++fd) {
    if (::fcntl(fd, F_GETFD) < 0) {
      // open() takes the lowest free number. Without this a pipe could get it, and be overwritten by the redirections.
      static_cast<void>(::open("/dev/null", O_RDWR));
    }
  }
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  ::sigaction(SIGCHLD, &action, nullptr);

  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < limit.rlim_max) {
    const rlimit raised{limit.rlim_max, limit.rlim_max};
    if (::setrlimit(RLIMIT_NOFILE, &raised) == 0) {
      limit_of_children_ = limit;
    }
  }
}

Process PosixProcessRunner::spawn(const ProcessSpec& spec) {
  const std::string program = spec.shell ? "/bin/sh" : find_program(spec);

  const bool has_terminal = spec.terminal_input && !spec.tty && ::isatty(STDIN_FILENO) == 1;
  if (has_terminal && !terminal_) {
    terminal_ = TerminalState::of(STDIN_FILENO);
  }
  ChildStreams streams = make_child_streams(spec, has_terminal);
  ChildProgram child{
      .program = program,
      .argv = command_line(spec),
      .environment = &spec.environment.variables(),
      .mark = spec.mark,
      .directory = spec.working_directory,
      .descriptors = {{STDIN_FILENO, has_terminal ? STDIN_FILENO : streams.in.child.get()},
                      {STDOUT_FILENO, streams.out.child.get()},
                      {STDERR_FILENO, streams.err.child.get()}},
      .only_given_descriptors = true,
      .open_files = spec.limits.open_files ? std::nullopt : limit_of_children_,
      .group = has_terminal ? ChildGroup::kOurs : (spec.tty ? ChildGroup::kOwnTerminal : ChildGroup::kOwn),
      .signals = ChildSignals::kFresh,
  };
  const Namespaces* const namespaces = namespaces_of_(spec);
  const bool wrapped = spec.limits.any() || namespaces != nullptr;
  Pipe failures;
  if (wrapped) {
    failures = make_pipe();
    child.descriptors.push_back({kLaunchExecError, failures.write.get()});
    std::vector<std::string> wrapper = launch_exec_arguments(spec.limits);
    if (namespaces != nullptr) {
      for (const ChildDescriptor& descriptor : namespaces->descriptors()) {
        child.descriptors.push_back(descriptor);
      }
      wrapper.insert(wrapper.end() - 1, namespaces->step());
    }
    wrapper.insert(wrapper.begin(), exec_program_);
    wrapper.push_back(program);
    child.argv.insert(child.argv.begin(), wrapper.begin(), wrapper.end());
    child.program = exec_program_;
  }

  Process process;
  try {
    process.pid = launch::spawn(child);
  } catch (const SpawnError& error) {
    throw spawn_failure(error.code().value(), spec, child.program);
  }
  if (wrapped) {
    failures.write.reset();
    if (const std::optional<LaunchExecFailure> failure = read_failure(failures.read)) {
      wait_for(process.pid);
      if (failure->step == kStepExec) {
        throw spawn_failure(failure->error, spec, program);
      }
      throw std::system_error(failure->error, std::system_category(),
                              limit_failure(failure->step, failure->error, spec.limits));
    }
  }
  process.pidfd.reset(static_cast<int>(::syscall(SYS_pidfd_open, process.pid, 0)));
  if (!process.pidfd) {
    const int open_error = errno;
    ::kill(has_terminal ? process.pid : -process.pid, SIGKILL);
    wait_for(process.pid);
    throw std::system_error(open_error, std::system_category(), "cannot open a descriptor for a process");
  }
  process.control_group = spec.limits.control_group;
  if (!process.control_group.empty()) {
    process.out_of_memory_before = ended_in(process.control_group);
  }
  process.has_terminal = has_terminal;
  process.mark = has_terminal ? spec.mark : std::string();
  process.pidfd = out_of_the_way(std::move(process.pidfd));
  process.in = out_of_the_way(std::move(streams.in.parent));
  process.out = out_of_the_way(std::move(streams.out.parent));
  process.err = out_of_the_way(std::move(streams.err.parent));
  return process;
}

bool PosixProcessRunner::signal_group(const Process& process, int signal) {
  if (process.has_terminal) {
    return signal_fellows(process, signal);
  }
  if (::kill(-process.pid, signal) != 0) {
    if (errno != ESRCH && errno != EPERM) {
      fail("cannot send a signal");
    }
    return errno != EPERM;
  }
  if (asks_to_end(signal)) {
    // A stopped group (reading the terminal from the background stops it) would not see the signal.
    ::kill(-process.pid, SIGCONT);
  }
  return true;
}

bool PosixProcessRunner::signal_fellows(const Process& process, int signal) {
  bool refused = false;
  bool sent = false;
  for (const pid_t pid : fellows_in_our_group(process)) {
    const bool done = ::kill(pid, signal) == 0;
    refused = refused || (!done && errno == EPERM);
    sent = sent || done;
    if (done && asks_to_end(signal)) {
      ::kill(pid, SIGCONT);
    }
  }
  return sent || !refused;
}

std::vector<bool> PosixProcessRunner::groups_live(const std::vector<const Process*>& leaders) {
  std::set<pid_t> groups;
  for (const FoundProcess& process : all_processes()) {
    if (!process.is_dead()) {
      groups.insert(process.group);
    }
  }
  std::vector<bool> live;
  for (const Process* const leader : leaders) {
    live.push_back(leader->has_terminal ? fellows_in_our_group(*leader).size() > 1 : groups.contains(leader->pid));
  }
  return live;
}

std::vector<StoppedChild> PosixProcessRunner::take_stopped() {
  std::vector<StoppedChild> stopped;
  for (siginfo_t info{}; ::waitid(P_ALL, 0, &info, WSTOPPED | WNOHANG) == 0 && info.si_pid != 0; info = {}) {
    stopped.push_back({info.si_pid, info.si_status});
  }
  return stopped;
}

std::optional<std::uint64_t> PosixProcessRunner::limit(const Process& process, int resource, std::uint64_t soft) {
  rlimit before{};
  const auto which = static_cast<__rlimit_resource>(resource);
  if (::prlimit(process.pid, which, nullptr, &before) != 0) {
    return std::nullopt;
  }
  const rlimit after{std::min<rlim_t>(soft, before.rlim_max), before.rlim_max};
  return ::prlimit(process.pid, which, &after, nullptr) == 0 ? std::optional<std::uint64_t>(before.rlim_cur)
                                                             : std::nullopt;
}

ProcessExit PosixProcessRunner::wait(const Process& process, int flags) {
  siginfo_t info{};
  ProcessExit exit;
  // Calls the kernel directly: only its waitid gives the resource usage of just this process.
  while (::syscall(SYS_waitid, P_PIDFD, process.pidfd.get(), &info, WEXITED | flags, &exit.usage) != 0) {
    if (errno != EINTR) {
      fail("cannot wait for a process");
    }
  }
  exit.code = info.si_code == CLD_EXITED ? info.si_status : -info.si_status;
  exit.core_dumped = info.si_code == CLD_DUMPED;
  exit.out_of_memory = info.si_code == CLD_KILLED && info.si_status == SIGKILL && !process.control_group.empty() &&
                       ended_in(process.control_group) > process.out_of_memory_before;
  if (process.has_terminal && terminal_) {
    terminal_->restore();
  }
  return exit;
}

}  // namespace

std::unique_ptr<ProcessRunner> make_posix_process_runner(const std::string& exec_program,
                                                         const Namespaces* namespaces) {
  return make_posix_process_runner(exec_program, [namespaces](const ProcessSpec&) { return namespaces; });
}

std::unique_ptr<ProcessRunner> make_posix_process_runner(
    const std::string& exec_program, std::function<const Namespaces*(const ProcessSpec&)> namespaces_of) {
  return std::make_unique<PosixProcessRunner>(exec_program, std::move(namespaces_of));
}

std::string default_exec_program() {
  return own_library_file("launch-exec");
}

}  // namespace launch
