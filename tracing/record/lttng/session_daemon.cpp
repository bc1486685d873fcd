// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/session_daemon.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <thread>

#include "base/environment/home_directory.hpp"
#include "base/environment/own_environment.hpp"
#include "base/files/small_file.hpp"
#include "base/files/unique_fd.hpp"
#include "base/processes/process_mark.hpp"
#include "base/processes/process_stat.hpp"
#include "base/processes/spawn.hpp"
#include "tracing/record/lttng/consumer_priority.hpp"
#include "tracing/record/lttng/kept_going.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

constexpr const char* kDaemon = "lttng-sessiond";
// For a daemon that another process is starting: LTTng has nothing to wait on.
constexpr std::chrono::seconds kLongestStart{10};
constexpr std::chrono::seconds kLongestEnd{10};
constexpr std::chrono::milliseconds kBetweenLooks{5};
constexpr const char* kInstallRemedy = "install LTTng: sudo apt-get install lttng-tools liblttng-ust-dev";

bool daemon_answers() {
  return lttng_session_daemon_alive() == 1;
}

// Root's daemon has its file in the global run directory, whatever LTTNG_HOME says. Each other user has a daemon of
// their own. If root's daemon runs, it serves the members of group `tracing`, and the file of their own daemon does not
// exist.
std::string pid_file_of_daemon() {
  if (geteuid() == 0) {
    return "/run/lttng/lttng-sessiond.pid";
  }
  const char* const given = std::getenv("LTTNG_HOME");
  const std::string home = given != nullptr && *given != '\0' ? given : launch::home_directory();
  return home + "/.lttng/lttng-sessiond.pid";
}

// What the started daemon says goes to a memory file: a pipe of ours would be held open for the daemon's whole life,
// and the terminal would get LTTng's messages in place of ours.
class DaemonOutput {
 public:
  DaemonOutput() : fd_(memfd_create("lttng-sessiond-output", MFD_CLOEXEC | MFD_ALLOW_SEALING)) {}
  // The daemon keeps it for good: what it says from now on fails instead of filling memory.
  ~DaemonOutput() {
    if (fd_ < 0) {
      return;
    }
    fcntl(fd_, F_ADD_SEALS, F_SEAL_WRITE);
    close(fd_);
  }
  DaemonOutput(const DaemonOutput&) = delete;
  DaemonOutput& operator=(const DaemonOutput&) = delete;

  int fd() const { return fd_; }

  // The first line that is not empty.
  std::string first_line() const {
    std::array<char, 1024> text{};
    const ssize_t length = pread(fd_, text.data(), text.size(), 0);
    std::string_view rest(text.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
    rest.remove_prefix(std::min(rest.find_first_not_of('\n'), rest.size()));
    return std::string(rest.substr(0, rest.find('\n')));
  }

 private:
  int fd_;
};

[[noreturn]] void throw_spawn_error(const std::error_code& error) {
  if (error.value() == ENOENT) {
    throw SessionDaemonMissing(fmt::format("cannot trace: {} is not installed or not in PATH", kDaemon),
                               kInstallRemedy);
  }
  throw TraceError(fmt::format("cannot start {}: {}", kDaemon, error.message()), kInstallRemedy);
}

pid_t spawn_daemon(const DaemonOutput& output) {
  const int out = output.fd() >= 0 ? output.fd() : launch::kDevNull;
  launch::Environment environment = launch::own_environment();
  environment.insert_or_assign(launch::kLeaveRunningVariable, "1");  // others may use it when this launch has ended
  try {
    return launch::spawn({
        .program = kDaemon,
        // --daemonize would close every descriptor that the limit allows, one by one: 10 ms for 20,000, half a second
        // for the million of many containers. Here only the descriptors that it gets are open.
        .argv = {kDaemon, "--background"},
        .search_path = true,
        .environment = &environment.variables(),
        .descriptors = {{STDIN_FILENO, launch::kDevNull}, {STDOUT_FILENO, out}, {STDERR_FILENO, out}},
        .only_given_descriptors = true,
        // Our session would let Ctrl-C reach it; our blocked signals would make it deaf to SIGTERM for ever.
        .group = launch::ChildGroup::kOwnSession,
        .signals = launch::ChildSignals::kFresh,
    });
  } catch (const std::system_error& error) {
    throw_spawn_error(error.code());
  }
}

// Whether somebody has locked the file with flock(). Trying to lock it could be in the way of a daemon that starts.
bool is_flocked(int fd) {
  struct stat file {};
  if (fstat(fd, &file) != 0) {
    return false;
  }
  const std::string id = fmt::format(" {:02x}:{:02x}:{} ", major(file.st_dev), minor(file.st_dev), file.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    if (line.find(" FLOCK ") != std::string::npos && line.find(id) != std::string::npos) {
      return true;
    }
  }
  return false;
}

// The process that starts a daemon first holds this lock. The daemons of the others give up before the first one
// answers. In LTTng 2.13.9 it is a lock of fcntl(), which ends with the start; in 2.13.15 one of flock(), which the
// daemon has until it ends.
bool another_daemon_starts() {
  const std::string lock_file = std::filesystem::path(pid_file_of_daemon()).replace_extension(".lck");
  const int fd = open(lock_file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) {
    return false;
  }
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  const bool held = (fcntl(fd, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK) || is_flocked(fd);
  close(fd);
  return held;
}

// With --background the started process ends when the daemon it left behind accepts commands.
void start_daemon() {
  const DaemonOutput output;
  const auto give_up = std::chrono::steady_clock::now() + kLongestStart;
  bool another = false;
  do {
    launch::wait_for(spawn_daemon(output));
    another = false;
    while (!daemon_answers() && another_daemon_starts() && std::chrono::steady_clock::now() < give_up) {
      another = true;
      std::this_thread::sleep_for(kBetweenLooks);
    }
    if (daemon_answers()) {
      return;  // also when another process was faster than we
    }
    // If another daemon had the lock, it was about to end.
  } while (another && std::chrono::steady_clock::now() < give_up);

  const std::string said = output.first_line();
  throw TraceError(
      fmt::format("{} was started but does not answer{}{}", kDaemon, said.empty() ? "" : ": ", said),
      fmt::format(
          "run `{} --verbose` to see why; a daemon of another container that shares HOME is kept apart by another "
          "LTTNG_HOME",
          kDaemon));
}

// 0 when there is none.
pid_t read_pid(const std::string& pid_file) {
  const std::string text = launch::read_small_file(pid_file).value_or("");
  pid_t pid = 0;
  std::from_chars(text.data(), text.data() + text.size(), pid);
  return std::max(pid, 0);
}

// The process that listens where programs find the session daemon. Its pid file may be elsewhere (--pidfile), or gone.
pid_t daemon_at_socket() {
  const std::string path = session_daemon_directory() + "/client-lttng-sessiond";
  const launch::UniqueFd connection(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  ucred peer{};
  socklen_t size = sizeof peer;
  if (connect(connection.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      getsockopt(connection.get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) {
    return 0;
  }
  return peer.pid;
}

void check_not_stopped(pid_t pid, const launch::ProcessStat& process) {
  if (process.name != kDaemon || process.state != 'T' || is_kept_going(pid)) {
    return;
  }
  throw TraceError(fmt::format("the LTTng session daemon (process {}) is stopped and does not answer", pid),
                   fmt::format("continue it with `kill -CONT {}`", pid));
}

}  // namespace

void check_daemon_is_here(const std::string& pid_file) {
  const pid_t pid = read_pid(pid_file);
  if (pid == 0) {
    return;
  }
  const launch::ProcessStat process = launch::read_process_stat(pid);
  const bool hidden = process.name.empty() && kill(pid, 0) != 0 && errno == EPERM;  // /proc with hidepid
  if (hidden) {
    return;
  }
  if (process.name != kDaemon || process.state == 'Z') {
    throw TraceError(
        fmt::format("the LTTng session daemon exists but is unreachable: {} names process {}, which is not a {} here",
                    pid_file, pid, kDaemon),
        "another container shares this home directory: give each container its own LTTNG_HOME (LTTng bug 1371)");
  }
  check_not_stopped(pid, process);
}

std::string session_daemon_directory() {
  return std::filesystem::path(pid_file_of_daemon()).parent_path().string();
}

pid_t session_daemon_pid() {
  const pid_t pid = read_pid(pid_file_of_daemon());
  return pid != 0 ? pid : daemon_at_socket();
}

bool session_daemon_can_answer() {
  const pid_t pid = session_daemon_pid();
  return pid == 0 || launch::read_process_stat(pid).state != 'T';
}

void check_daemon_not_stopped() {
  if (const pid_t pid = session_daemon_pid(); pid != 0) {
    check_not_stopped(pid, launch::read_process_stat(pid));
  }
}

void check_daemons_not_stopped() {
  const pid_t pid = session_daemon_pid();
  if (pid == 0) {
    return;
  }
  check_not_stopped(pid, launch::read_process_stat(pid));
  for (const pid_t consumer : consumers_of(pid)) {
    if (launch::read_process_stat(consumer).state == 'T' && !is_kept_going(consumer)) {
      throw TraceError(fmt::format("LTTng's consumer (process {}) is stopped and does not answer", consumer),
                       fmt::format("continue it with `kill -CONT {}`", consumer));
    }
  }
}

bool session_daemon_is_ours() {
  const pid_t pid = session_daemon_pid();
  if (pid == 0 || launch::read_process_stat(pid).name != kDaemon) {
    return false;
  }
  std::ifstream environment(fmt::format("/proc/{}/environ", pid));
  const std::string mark = std::string(launch::kLeaveRunningVariable) + "=1";
  for (std::string variable; std::getline(environment, variable, '\0');) {
    if (variable == mark) {
      return true;
    }
  }
  return false;
}

void restart_session_daemon() {
  const pid_t pid = session_daemon_pid();
  if (pid != 0 && kill(pid, SIGTERM) == 0 && !launch::ends_within(pid, kLongestEnd)) {
    throw TraceError(fmt::format("the LTTng session daemon (process {}) does not end", pid),
                     fmt::format("end it with `kill -9 {}`", pid));
  }
  start_daemon();
}

bool ensure_session_daemon() {
  // A stopped daemon accepts the connection and would block us for ever: look at the process first.
  const bool alive = daemon_answers();
  if (!alive) {
    start_daemon();
  }
  check_daemon_is_here(pid_file_of_daemon());
  return !alive;
}

}  // namespace tracing
