// SPDX-License-Identifier: Apache-2.0
#include "launch_trace_testing/launch_run.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/inotify.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "base/environment/domain_lease.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/test_run_variables.hpp"
#include "base/files/unique_fd.hpp"
#include "base/processes/left_behind.hpp"
#include "base/processes/spawn.hpp"
#include "launch_trace_testing/event_query.hpp"
#include "tracing/expect/wrapper_file.hpp"

namespace launch_trace_testing {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

constexpr const char* kSession = "test";
constexpr std::chrono::seconds kEndPatience{30};  // from SIGINT to SIGKILL

fs::path make_directory() {
  const char* const parent = ::getenv("TMPDIR");
  std::string name = (fs::path(parent != nullptr && *parent != '\0' ? parent : "/tmp") / "launch-run-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw std::system_error(errno, std::generic_category(), "cannot make " + name);
  }
  return name;
}

// `launch` of the installation that this code belongs to, if it is part of one.
fs::path neighbour_program() {
  Dl_info info;
  if (::dladdr(reinterpret_cast<void*>(&neighbour_program), &info) == 0 || info.dli_fname == nullptr) {
    return {};
  }
  std::error_code ignored;
  // A library is in lib, a module of Python some folders below.
  fs::path folder = fs::canonical(info.dli_fname, ignored);
  while (folder.has_relative_path()) {
    folder = folder.parent_path();
    if (fs::path program = folder / "bin" / "launch"; fs::exists(program, ignored)) {
      return program;
    }
  }
  return {};
}

fs::path launch_program(const RunOptions& options) {
  if (!options.launch_program.empty()) {
    return options.launch_program;
  }
  if (const char* const given = ::getenv("LAUNCH_PROGRAM"); given != nullptr && *given != '\0') {
    return given;
  }
  const fs::path neighbour = neighbour_program();
  return neighbour.empty() ? fs::path("launch") : neighbour;
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

launch::UniqueFd new_file(const fs::path& path) {
  launch::UniqueFd file(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  if (!file) {
    throw std::system_error(errno, std::generic_category(), "cannot write " + path.string());
  }
  return file;
}

// From lines such as "[INFO] [talker-1]: process started with pid [42]". Lines of the processes begin with their label.
std::set<std::int64_t> started_processes(const std::string& out) {
  static const std::regex pattern(R"(^\[INFO\] \[[^\]]*\]: process started with pid \[(\d+)\]$)");
  std::set<std::int64_t> processes;
  std::istringstream lines(out);
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, match, pattern)) {
      processes.insert(std::stoll(match[1]));
    }
  }
  return processes;
}

std::string last_lines(const std::string& text) {
  constexpr std::size_t kMost = 2000;
  return text.size() <= kMost ? text : "…" + text.substr(text.size() - kMost);
}

}  // namespace

struct LaunchRun::State {
  RunOptions options;
  launch::DomainLease domain;
  fs::path directory = make_directory();
  fs::path traces = directory / "traces";
  fs::path file = directory / "run.launch.xml";
  std::string suffix = "_" + directory.filename().string();  // of the names of its sessions
  std::string session = kSession + suffix;
  launch::UniqueFd changes{::inotify_init1(IN_CLOEXEC | IN_NONBLOCK)};
  pid_t pid = -1;
  launch::UniqueFd pidfd;
  bool has_ended = false;
  bool keeps = false;
  RunResult result;

  fs::path out() const { return directory / "stdout.txt"; }
  fs::path err() const { return directory / "stderr.txt"; }

  void start() {
    fs::create_directories(traces);
    std::ofstream(file) << wrapper_file(options, kSession, traces);
    std::map<std::string, std::string> environment = launch::own_environment();
    environment["ROS_DOMAIN_ID"] = std::to_string(domain.id());
    environment["ROS_HOME"] = (directory / "ros").string();
    environment["ROS_LOG_DIR"] = (directory / "log").string();
    environment["ROS_TRACE_DIR"] = traces.string();
    environment[launch::kSessionSuffixVariable] = suffix;
    for (const auto& [name, value] : options.environment) {
      environment[name] = value;
    }
    const launch::UniqueFd out_file = new_file(out());
    const launch::UniqueFd err_file = new_file(err());
    ::inotify_add_watch(changes.get(), out().c_str(), IN_MODIFY);
    ::inotify_add_watch(changes.get(), err().c_str(), IN_MODIFY);
    const std::string program = launch_program(options).string();
    pid = launch::spawn({.program = program,
                         .argv = {"launch", file.string()},
                         .search_path = program.find('/') == std::string::npos,
                         .environment = &environment,
                         .descriptors = {{STDIN_FILENO, launch::kDevNull},
                                         {STDOUT_FILENO, out_file.get()},
                                         {STDERR_FILENO, err_file.get()}},
                         .group = launch::ChildGroup::kOwn,
                         .signals = launch::ChildSignals::kFresh});
    pidfd.reset(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
  }

  // Waits for the end of the launcher, or for output if `for_output`. False when the time is over.
  bool wait_until(Clock::time_point end, bool for_output) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) {
      return false;
    }
    pollfd descriptors[] = {{pidfd.get(), POLLIN, 0}, {changes.get(), POLLIN, 0}};
    if (::poll(descriptors, for_output ? 2 : 1, static_cast<int>(std::min<std::int64_t>(left, 1'000'000))) < 0) {
      return errno == EINTR;
    }
    char events[4096];
    while (for_output && ::read(changes.get(), events, sizeof events) > 0) {
      continue;
    }
    return true;
  }

  bool is_running() const {
    pollfd descriptor{pidfd.get(), POLLIN, 0};
    return !has_ended && ::poll(&descriptor, 1, 0) == 0;
  }

  // Waits for the end; false when the time is over.
  bool ends_before(Clock::time_point end) {
    while (is_running()) {
      if (!wait_until(end, false)) {
        return !is_running();
      }
    }
    return true;
  }

  void end_gently() {
    ::kill(pid, SIGINT);
    if (!ends_before(Clock::now() + kEndPatience)) {
      ::kill(pid, SIGKILL);
    }
  }

  RunResult reap() {
    if (has_ended) {
      return result;
    }
    const int status = launch::wait_for(pid);
    has_ended = true;
    if (WIFEXITED(status)) {
      result.exit_code = WEXITSTATUS(status);
    }
    if (WIFSIGNALED(status)) {
      result.signal = WTERMSIG(status);
    }
    result.out = read_file(out());
    result.err = read_file(err());
    result.left = launch::left_behind(result.out + result.err);
    return result;
  }
};

LaunchRun::LaunchRun(RunOptions options) : state_(std::make_unique<State>()) {
  state_->options = std::move(options);
  try {
    state_->start();
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(state_->directory, ignored);
    throw;
  }
}

LaunchRun::~LaunchRun() {
  if (!state_->has_ended) {
    state_->end_gently();
    state_->reap();
  }
  std::error_code ignored;
  if (!state_->keeps) {
    fs::remove_all(state_->directory, ignored);
  }
}

RunResult LaunchRun::wait() {
  if (!state_->has_ended && !state_->ends_before(Clock::now() + state_->options.patience)) {
    state_->result.timed_out = true;
    state_->end_gently();
  }
  return state_->reap();
}

RunResult LaunchRun::stop() {
  if (!state_->has_ended && state_->is_running()) {
    state_->end_gently();
  }
  return state_->reap();
}

bool LaunchRun::wait_for_output(const std::string& text) {
  const Clock::time_point end = Clock::now() + state_->options.patience;
  const auto is_there = [&] { return out().find(text) != std::string::npos || err().find(text) != std::string::npos; };
  for (;;) {
    const bool running = state_->is_running();  // first, so that no output is missed
    if (is_there()) {
      return true;
    }
    if (!running || !state_->wait_until(end, true)) {
      return is_there();
    }
  }
}

std::string LaunchRun::out() const {
  return read_file(state_->out());
}

std::string LaunchRun::err() const {
  return read_file(state_->err());
}

Trace LaunchRun::trace() const {
  if (!state_->has_ended) {
    throw TraceError("the run has not ended; call wait() or stop() first");
  }
  const bool is_ours = !state_->options.events.empty();
  const fs::path directory = is_ours ? state_->traces / state_->session : state_->traces;
  if (!fs::exists(directory) || fs::is_empty(directory)) {
    throw TraceError(fmt::format("the run has no trace; the launcher ended with {} and said:\n{}{}",
                                 state_->result.exit_code, last_lines(state_->result.out),
                                 last_lines(state_->result.err)));
  }
  if (!is_ours || state_->options.all_processes) {
    return Trace(directory);
  }

  // The session records every program of the user. The launcher says which of them the run has started. Its own events
  // tell its process; they are missing if the session daemon was too busy to register it before its end.
  std::set<std::int64_t> processes = started_processes(state_->result.out);
  const Trace launchers(directory, {.accepts = [](const Event& event) { return event.name() == "launch:load"; }});
  const Event* const load = event("launch:load").with("file", state_->file.string()).first(launchers);
  if (load != nullptr) {
    processes.insert(load->vpid());
  }
  return Trace(directory, {.accepts = [&](const Event& event) { return processes.contains(event.vpid()); }});
}

const fs::path& LaunchRun::directory() const {
  return state_->directory;
}

const fs::path& LaunchRun::trace_directory() const {
  return state_->traces;
}

int LaunchRun::domain_id() const {
  return state_->domain.id();
}

void LaunchRun::keep() {
  state_->keeps = true;
}

}  // namespace launch_trace_testing
