// SPDX-License-Identifier: Apache-2.0
// The ProcessRunner on posix_spawn(3). Never fork(2): the launcher has threads.
#include <fcntl.h>
#include <linux/close_range.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "launcher/base/unique_fd.hpp"
#include "launcher/process/exec/launch_exec_protocol.hpp"
#include "launcher/process/process_runner.hpp"
#include "launcher/process/program_search.hpp"
#include "launcher/process/spawn_failure.hpp"

namespace launch {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::system_category(), what);
}

void check(int error, const char* what) {
  if (error != 0) {
    throw std::system_error(error, std::system_category(), what);
  }
}

// Two ends of a pipe or of a pseudo-terminal, both close-on-exec.
struct Channel {
  UniqueFd parent;
  UniqueFd child;
};

Channel make_pipe(int parent_end) {
  std::array<int, 2> fds{};
  if (::pipe2(fds.data(), O_CLOEXEC) != 0) {
    fail("cannot create a pipe");
  }
  Channel channel{UniqueFd(fds[static_cast<std::size_t>(parent_end)]),
                  UniqueFd(fds[static_cast<std::size_t>(1 - parent_end)])};
  return channel;
}

// Reads must not block, but the flag must not reach the child: the two ends of a pipe have flags of their own.
void set_nonblocking(const UniqueFd& fd) {
  if (::fcntl(fd.get(), F_SETFL, O_NONBLOCK) != 0) {
    fail("cannot make a pipe non-blocking");
  }
}

Channel make_output_pipe() {
  Channel channel = make_pipe(0);
  set_nonblocking(channel.parent);
  return channel;
}

Channel make_pseudo_terminal() {
  Channel channel;
  channel.parent.reset(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
  if (!channel.parent || ::grantpt(channel.parent.get()) != 0 || ::unlockpt(channel.parent.get()) != 0) {
    fail("cannot create a pseudo-terminal");
  }
  channel.child.reset(::ioctl(channel.parent.get(), TIOCGPTPEER, O_RDWR | O_NOCTTY | O_CLOEXEC));
  if (!channel.child) {
    fail("cannot open a pseudo-terminal");
  }
  return channel;
}

class FileActions {
 public:
  FileActions() { check(posix_spawn_file_actions_init(&actions_), "cannot prepare a process"); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  void redirect(const UniqueFd& from, int to) {
    check(posix_spawn_file_actions_adddup2(&actions_, from.get(), to), "cannot prepare a process");
  }
  void change_directory(const std::string& path) {
    check(posix_spawn_file_actions_addchdir_np(&actions_, path.c_str()), "cannot prepare a process");
  }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

class SpawnAttributes {
 public:
  SpawnAttributes() {
    check(posix_spawnattr_init(&attributes_), "cannot prepare a process");
    sigset_t signals;
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

// A null-terminated array of C strings, as exec wants it.
class StringArray {
 public:
  explicit StringArray(const std::vector<std::string>& strings) {
    reserve(strings.size());
    for (const std::string& string : strings) {
      pointers_.push_back(const_cast<char*>(string.c_str()));  // exec does not write, C has no way to say so
    }
    pointers_.push_back(nullptr);
  }
  explicit StringArray(const std::map<std::string, std::string>& variables) {
    reserve(variables.size());
    std::size_t size = 0;
    for (const auto& [name, value] : variables) {
      size += name.size() + value.size() + 2;
    }
    text_.reserve(size);  // so that no pointer moves
    for (const auto& [name, value] : variables) {
      pointers_.push_back(text_.data() + text_.size());
      text_.append(name).append("=").append(value).push_back('\0');
    }
    pointers_.push_back(nullptr);
  }
  char* const* get() const { return pointers_.data(); }

 private:
  void reserve(std::size_t count) { pointers_.reserve(count + 1); }

  std::string text_;
  std::vector<char*> pointers_;
};

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

// What launch-exec has to say before it becomes the program: nothing, when all went well.
std::optional<LaunchExecFailure> read_failure(const UniqueFd& pipe) {
  LaunchExecFailure failure{};
  ssize_t size = 0;
  do {
    size = ::read(pipe.get(), &failure, sizeof failure);
  } while (size < 0 && errno == EINTR);
  return size == sizeof failure ? std::optional(failure) : std::nullopt;
}

class PosixProcessRunner final : public ProcessRunner {
 public:
  explicit PosixProcessRunner(std::string exec_program);

  Process spawn(const ProcessSpec& spec) override;
  void signal_group(const Process& process, int signal) override;
  ProcessExit outcome(const Process& process) override { return wait(process, WNOWAIT); }
  ProcessExit reap(const Process& process) override { return wait(process, 0); }

 private:
  static ProcessExit wait(const Process& process, int flags);

  std::string exec_program_;
  SpawnAttributes attributes_;
  std::optional<rlimit> limit_of_children_;  // only if it differs from the launcher's
};

PosixProcessRunner::PosixProcessRunner(std::string exec_program) : exec_program_(std::move(exec_program)) {
  for (int fd = 0; fd <= 2; ++fd) {
    if (::fcntl(fd, F_GETFD) < 0) {
      // Takes the lowest free number. Without this a pipe could get it, and be overwritten by the redirections.
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

  Channel in = make_pipe(1);
  Channel out = spec.emulate_tty ? make_pseudo_terminal() : make_output_pipe();
  Channel err = spec.emulate_tty ? make_pseudo_terminal() : make_output_pipe();

  FileActions actions;
  actions.redirect(in.child, STDIN_FILENO);
  actions.redirect(out.child, STDOUT_FILENO);
  actions.redirect(err.child, STDERR_FILENO);
  if (!spec.working_directory.empty()) {
    actions.change_directory(spec.working_directory);
  }

  std::vector<std::string> strings = command_line(spec);
  const bool limited = spec.limits.any();
  Channel failures;
  if (limited) {
    failures = make_pipe(0);
    actions.redirect(failures.child, kLaunchExecError);
    std::vector<std::string> wrapper = launch_exec_arguments(spec.limits);
    wrapper.insert(wrapper.begin(), exec_program_);
    wrapper.push_back(program);
    strings.insert(strings.begin(), wrapper.begin(), wrapper.end());
  }
  const std::string& started = limited ? exec_program_ : program;
  const StringArray argv(strings);
  const StringArray environment(spec.environment);

  // Libraries open descriptors without close-on-exec, and whoever started us may have left some open. One call marks
  // them all (Linux 5.11; older kernels leave the marks as they are).
  static_cast<void>(::syscall(SYS_close_range, 3U, ~0U, CLOSE_RANGE_CLOEXEC));

  Process process;
  const int error =
      ::posix_spawn(&process.pid, started.c_str(), actions.get(), attributes_.get(), argv.get(), environment.get());
  if (error != 0) {
    throw spawn_failure(error, spec, started);
  }
  if (limited) {
    failures.child.reset();
    if (const std::optional<LaunchExecFailure> failure = read_failure(failures.parent)) {
      ::waitpid(process.pid, nullptr, 0);
      if (failure->step == kStepExec) {
        throw spawn_failure(failure->error, spec, program);
      }
      throw std::system_error(failure->error, std::system_category(),
                              limit_failure(failure->step, failure->error, spec.limits));
    }
  }
  if (limit_of_children_ && !spec.limits.open_files) {
    // Lowering our own limit around the spawn would be exact, but could fail an open() of another thread meanwhile.
    static_cast<void>(::prlimit(process.pid, RLIMIT_NOFILE, &*limit_of_children_, nullptr));
  }
  process.pidfd.reset(static_cast<int>(::syscall(SYS_pidfd_open, process.pid, 0)));
  if (!process.pidfd) {
    const int open_error = errno;
    ::kill(-process.pid, SIGKILL);
    ::waitpid(process.pid, nullptr, 0);
    throw std::system_error(open_error, std::system_category(), "cannot open a descriptor for a process");
  }
  process.in = std::move(in.parent);
  process.out = std::move(out.parent);
  process.err = std::move(err.parent);
  return process;
}

void PosixProcessRunner::signal_group(const Process& process, int signal) {
  if (::kill(-process.pid, signal) != 0 && errno != ESRCH && errno != EPERM) {
    fail("cannot send a signal");
  }
  if (signal == SIGTERM) {
    // A stopped group (reading the terminal from the background stops it) would not see the signal.
    ::kill(-process.pid, SIGCONT);
  }
}

ProcessExit PosixProcessRunner::wait(const Process& process, int flags) {
  siginfo_t info{};
  ProcessExit exit;
  // The system call itself: only it gives the resource usage of just this process.
  while (::syscall(SYS_waitid, P_PIDFD, process.pidfd.get(), &info, WEXITED | flags, &exit.usage) != 0) {
    if (errno != EINTR) {
      fail("cannot wait for a process");
    }
  }
  exit.code = info.si_code == CLD_EXITED ? info.si_status : -info.si_status;
  return exit;
}

}  // namespace

std::unique_ptr<ProcessRunner> make_posix_process_runner(const std::string& exec_program) {
  return std::make_unique<PosixProcessRunner>(exec_program);
}

std::string default_exec_program() {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  return (self.parent_path().parent_path() / "lib/launch/launch-exec").string();
}

}  // namespace launch
