// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/fake/fake_process_runner.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace launch {
namespace {

std::array<UniqueFd, 2> make_pipe() {
  std::array<int, 2> fds{};
  if (::pipe2(fds.data(), O_CLOEXEC | O_NONBLOCK) != 0) {
    throw std::system_error(errno, std::system_category(), "cannot create a pipe");
  }
  return {UniqueFd(fds[0]), UniqueFd(fds[1])};
}

}  // namespace

struct FakeProcessRunner::Running {
  FakeScript script;
  UniqueFd exited;  // an eventfd as pidfd
  UniqueFd out;
  UniqueFd err;
  UniqueFd in;
  bool dead = false;
  bool dying = false;
  ProcessExit exit;
  std::vector<EventLoop::SourcePtr> timers;
  EventLoop::SourcePtr descendants;
  bool left = false;  // the descendants have left the group

  void close_output() {
    out.reset();
    err.reset();
    descendants.reset();
  }
};

FakeProcessRunner::FakeProcessRunner(FakeEventLoop& loop) : loop_(loop) {}

FakeProcessRunner::~FakeProcessRunner() = default;

void FakeProcessRunner::script(const std::string& name, std::vector<FakeScript> runs) {
  scripts_[name] = std::move(runs);
  runs_[name] = 0;
}

void FakeProcessRunner::default_script(FakeScript run) {
  default_ = std::move(run);
}

const FakeScript& FakeProcessRunner::next_script(const std::string& name) {
  const auto found = scripts_.find(name);
  if (found == scripts_.end()) {
    return default_;
  }
  const std::size_t run = runs_[name]++;
  return found->second.at(std::min(run, found->second.size() - 1));
}

Process FakeProcessRunner::spawn(const ProcessSpec& spec) {
  const FakeScript script = next_script(spec.name);
  loop_.pass(script.start_takes);
  if (script.spawn_error) {
    spawned_.push_back({spec, -1, loop_.now()});
    throw std::system_error(*script.spawn_error, std::system_category(),
                            fmt::format("cannot start '{}'", spec.argv.front()));
  }
  auto owned = std::make_unique<Running>();
  Running& running = *owned;
  running.script = script;
  Process process;
  process.pid = ++last_pid_;
  process.has_terminal = spec.terminal_input && !script.lacks_terminal;
  auto out = make_pipe();
  auto err = make_pipe();
  process.out = std::move(out[0]);
  process.err = std::move(err[0]);
  running.out = std::move(out[1]);
  running.err = std::move(err[1]);
  auto in = make_pipe();
  running.in = std::move(in[0]);
  process.in = std::move(in[1]);
  running.exited.reset(::eventfd(0, EFD_CLOEXEC));
  process.pidfd.reset(::fcntl(running.exited.get(), F_DUPFD_CLOEXEC, 0));
  if (!process.pidfd) {
    throw std::system_error(errno, std::system_category(), "cannot create an eventfd");
  }
  for (const FakeScript::Output& output : script.output) {
    running.timers.push_back(loop_.after(output.at, [&running, output] {
      const UniqueFd& fd = output.to_err ? running.err : running.out;
      if (fd && ::write(fd.get(), output.text.data(), output.text.size()) != static_cast<ssize_t>(output.text.size())) {
        throw std::logic_error("the output of a fake process does not fit into a pipe");
      }
    }));
  }
  if (script.exits_after) {
    running.timers.push_back(
        loop_.after(*script.exits_after, [this, &running] { exit(running, running.script.exit_code); }));
  }
  spawned_.push_back({spec, process.pid, loop_.now()});
  running_.emplace(process.pid, std::move(owned));
  return process;
}

std::string FakeProcessRunner::take_input(pid_t pid) {
  std::string text;
  std::array<char, 1024> bytes{};
  for (ssize_t size = 0; (size = ::read(running_.at(pid)->in.get(), bytes.data(), bytes.size())) > 0;) {
    text.append(bytes.data(), static_cast<std::size_t>(size));
  }
  return text;
}

bool FakeProcessRunner::signal_group(const Process& process, int signal) {
  signals_.push_back({process.pid, signal, loop_.now()});
  Running& running = find(process);
  if (running.script.refuses_signals) {
    return false;
  }
  const bool deadly =
      signal == SIGKILL || ((signal == SIGINT || signal == SIGTERM) && !running.script.ignores.contains(signal));
  if (!deadly) {
    return true;
  }
  if (running.dead) {
    if (!running.left) {
      running.close_output();
    }
    return true;
  }
  const int code = signal == SIGKILL ? -SIGKILL : running.script.exit_code_on_signal.value_or(-signal);
  if (signal == SIGKILL || running.script.dies_after == Duration{0}) {
    exit(running, code);
    if (signal == SIGKILL) {
      running.close_output();
    }
  } else if (!running.dying) {
    running.dying = true;
    running.timers.push_back(loop_.after(running.script.dies_after, [this, &running, code] { exit(running, code); }));
  }
  return true;
}

void FakeProcessRunner::exit(Running& process, int code) {
  if (process.dead) {
    return;
  }
  process.dead = true;
  process.exit.code = code;
  if (process.script.descendants_for) {
    process.descendants = loop_.after(*process.script.descendants_for, [&process] {
      process.out.reset();
      process.err.reset();
    });
    if (process.script.descendants_leave_after) {
      process.timers.push_back(
          loop_.after(*process.script.descendants_leave_after, [&process] { process.left = true; }));
    }
  } else {
    process.close_output();
  }
  ::eventfd_write(process.exited.get(), 1);
}

std::optional<std::uint64_t> FakeProcessRunner::limit(const Process& process, int resource, std::uint64_t soft) {
  std::uint64_t before = kSoftLimit;
  for (const Limited& earlier : limits_) {
    if (earlier.pid == process.pid && earlier.resource == resource) {
      before = earlier.soft;
    }
  }
  limits_.push_back({process.pid, resource, soft, loop_.now()});
  return before;
}

std::vector<bool> FakeProcessRunner::groups_live(const std::vector<const Process*>& leaders) {
  std::vector<bool> live;
  for (const Process* const leader : leaders) {
    const Running& running = find(*leader);
    if (!running.dead) {
      throw std::logic_error("the group of a fake process was looked at before its exit");
    }
    live.push_back((running.out || running.err) && !running.left);
  }
  return live;
}

ProcessExit FakeProcessRunner::outcome(const Process& process) {
  const Running& running = find(process);
  if (!running.dead) {
    throw std::logic_error("a fake process was waited for before its exit");
  }
  return running.exit;
}

ProcessExit FakeProcessRunner::reap(const Process& process) {
  const ProcessExit exit = outcome(process);
  running_.erase(process.pid);
  return exit;
}

FakeProcessRunner::Running& FakeProcessRunner::find(const Process& process) const {
  const auto found = running_.find(process.pid);
  if (found == running_.end()) {
    throw std::logic_error(fmt::format("the fake process {} was used after it had been reaped", process.pid));
  }
  return *found->second;
}

std::vector<int> FakeProcessRunner::signals_of(pid_t pid) const {
  std::vector<int> result;
  for (const Signalled& sent : signals_) {
    if (sent.pid == pid) {
      result.push_back(sent.signal);
    }
  }
  return result;
}

std::size_t FakeProcessRunner::unreaped() const {
  return running_.size();
}

}  // namespace launch
