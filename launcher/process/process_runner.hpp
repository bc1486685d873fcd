// SPDX-License-Identifier: Apache-2.0
// Starts and signals operating system processes. The seam between the supervisor and the kernel.
#pragma once

#include <cerrno>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "launcher/process/group_scheduling.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

class Namespaces;

// A child that a signal has stopped.
struct StoppedChild {
  pid_t pid;
  int signal;
};

// The process can't be started, and another try would not help.
class NeverStarts : public std::system_error {
 public:
  // `what` is the whole text.
  NeverStarts(int error, std::string what) : std::system_error(error, std::system_category()), what_(std::move(what)) {}
  const char* what() const noexcept override { return what_.c_str(); }

 private:
  std::string what_;
};

class ProcessRunner {
 public:
  virtual ~ProcessRunner() = default;

  // Starts a process in a process group of its own, with default signal dispositions and nothing blocked. A process
  // that gets the terminal stays in the group of the launcher. One with a tty leads a session on it.
  // Throws std::system_error when it can't be started (no such program, no permission, no such directory).
  virtual Process spawn(const ProcessSpec& spec) = 0;

  // Of a process that spawn() has returned with `starting`: its pidfd has become readable, so it is known whether it
  // has started. Sets its pid; from now on the pidfd is readable when it has exited. Throws as spawn() does.
  virtual void confirm(Process& process) { process.starting = false; }

  // Sends a signal to every process of the group of `process`. A group that is gone is not an error. False when each
  // process of the group belongs to another user, so that none got the signal.
  virtual bool signal_group(const Process& process, int signal) = 0;

  // Sets a soft limit of a process that runs, such as RLIMIT_NOFILE; the hard limit stays. Returns the soft limit
  // before; nullopt when the system refuses.
  virtual std::optional<std::uint64_t> limit(const Process& process, int resource, std::uint64_t soft) = 0;

  // As change_scheduling() and restore_scheduling() of group_scheduling.hpp, for all threads of the group of `process`.
  virtual std::optional<SchedulingFailure> change_scheduling(const Process&, const ResourceLimits& /*wanted*/,
                                                             GroupScheduling& /*before*/) {
    return SchedulingFailure{0, ENOTSUP};
  }
  virtual std::optional<SchedulingFailure> restore_scheduling(const Process&, const GroupScheduling& /*before*/) {
    return SchedulingFailure{0, ENOTSUP};
  }

  // For each of these processes, which have exited and are not reaped: whether another process of its group has not
  // ended. Takes one look at all processes of the machine.
  virtual std::vector<bool> groups_live(const std::vector<const Process*>& leaders) = 0;

  // The children that have been stopped since the last call.
  virtual std::vector<StoppedChild> take_stopped() = 0;

  // After SIGSTOP: waits until no thread of a process that has the terminal runs any more. A thread that reads the
  // terminal and has not seen the signal would take input that is meant for the shell. Gives up after a second, because
  // a thread that waits for a device stops only when the device answers.
  virtual void await_stop(const Process& process) = 0;

  // Whether the launcher and the processes that have the terminal may read it now.
  virtual bool in_foreground() const = 0;

  // How an exited process ended, without reaping it: its number, and with it the number of its group, stays reserved,
  // so that signal_group() can't hit strangers. Must only be called once its pidfd is readable.
  virtual ProcessExit outcome(const Process& process) = 0;

  // Whether the log of the kernel says that it has ended this process for want of memory. `started` is the time of the
  // loop at which it was started.
  virtual bool was_ended_by_kernel(const Process&, Duration /*started*/) { return false; }

  // Reaps an exited process. Must only be called once its pidfd is readable. Sets code and usage.
  virtual ProcessExit reap(const Process& process) = 0;
};

// ../lib/launch/launch-exec, relative to the directory of this program.
std::string default_exec_program();

// spawn() and pidfds. Prepares the launcher itself: SIGCHLD gets its default disposition (else children would be reaped
// by the kernel), closed standard descriptors become /dev/null, and the soft limit of open descriptors is raised to the
// hard one. Children have the old limit, and no descriptors but the standard ones.
//
// A process with limits is started through `exec_program`, launch-exec, which applies the limits to itself and then
// becomes the program. spawn() returns when that has happened, and throws when a limit is refused. The same holds for
// every process if there are `namespaces`, which must outlive the runner.
std::unique_ptr<ProcessRunner> make_posix_process_runner(const std::string& exec_program = default_exec_program(),
                                                         const Namespaces* namespaces = nullptr);
// `namespaces_of` says in which namespaces a process starts; null: in none of its own.
std::unique_ptr<ProcessRunner> make_posix_process_runner(
    const std::string& exec_program, std::function<const Namespaces*(const ProcessSpec&)> namespaces_of);

}  // namespace launch
