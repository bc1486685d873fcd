// SPDX-License-Identifier: Apache-2.0
#include "tests/support/command.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace test_support {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

struct Pipe {
  int read_end = -1;
  int write_end = -1;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe2");
  }
  return {ends[0], ends[1]};
}

void close_fd(int& fd) {
  if (fd >= 0) {
    close(fd);
  }
  fd = -1;
}

milliseconds until(Clock::time_point deadline) {
  return std::max(milliseconds(0), std::chrono::ceil<milliseconds>(deadline - Clock::now()));
}

std::vector<std::string> merged_environment(const std::map<std::string, std::string>& overrides) {
  std::map<std::string, std::string> merged;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::size_t equals = text.find('=');
    if (equals != std::string::npos) {
      merged[text.substr(0, equals)] = text.substr(equals + 1);
    }
  }
  for (const auto& [name, value] : overrides) {
    merged[name] = value;
  }
  std::vector<std::string> entries;
  for (const auto& [name, value] : merged) {
    entries.push_back(name + "=" + value);
  }
  return entries;
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> result;
  for (std::string& string : strings) {
    result.push_back(string.data());
  }
  result.push_back(nullptr);
  return result;
}

// Appends what can be read from `fd`. Closes `fd` at its end.
void read_available(int& fd, std::string& text) {
  std::array<char, 16384> buffer{};
  while (fd >= 0) {
    const ssize_t length = read(fd, buffer.data(), buffer.size());
    if (length > 0) {
      text.append(buffer.data(), static_cast<std::size_t>(length));
    } else if (length == 0) {
      close_fd(fd);
    } else if (errno != EINTR) {
      return;  // EAGAIN: nothing more for now
    }
  }
}

}  // namespace

RunningCommand::RunningCommand(const Command& command) {
  Pipe in = make_pipe();
  Pipe out = make_pipe();
  Pipe err = make_pipe();

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.read_end, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.write_end, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.write_end, STDERR_FILENO);
  if (!command.directory.empty()) {
    posix_spawn_file_actions_addchdir_np(&actions, command.directory.c_str());
  }
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  sigset_t all;
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

  std::vector<std::string> argv = command.argv;
  std::vector<std::string> environment = merged_environment(command.environment);
  const int error = posix_spawnp(&pid_, argv.at(0).c_str(), &actions, &attributes, pointers(argv).data(),
                                 pointers(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  for (int* theirs : {&in.read_end, &out.write_end, &err.write_end}) {
    close_fd(*theirs);
  }
  in_ = in.write_end;
  out_ = out.read_end;
  err_ = err.read_end;
  if (error == 0) {
    pidfd_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
  }
  if (error != 0 || pidfd_ < 0) {
    const int reason = error != 0 ? error : errno;
    for (int* ours : {&in_, &out_, &err_}) {
      close_fd(*ours);
    }
    throw std::system_error(reason, std::generic_category(), "cannot start " + argv[0]);
  }
  for (const int fd : {out_, err_}) {
    fcntl(fd, F_SETFL, O_NONBLOCK);
  }
}

RunningCommand::~RunningCommand() {
  if (!ended_) {
    kill(-pid_, SIGKILL);
    reap();
  }
  for (int* fd : {&in_, &out_, &err_, &pidfd_}) {
    close_fd(*fd);
  }
}

CommandResult RunningCommand::end_gently() {
  send_signal(SIGINT);
  return wait();
}

bool RunningCommand::wait_for_output(const std::string& text, milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  while (true) {
    if (result_.out.find(text) != std::string::npos || result_.err.find(text) != std::string::npos) {
      return true;
    }
    if (Clock::now() >= deadline) {
      return false;
    }
    if (!read_some(until(deadline))) {
      drain();
      return result_.out.find(text) != std::string::npos || result_.err.find(text) != std::string::npos;
    }
  }
}

void RunningCommand::write(const std::string& text) {
  // A program that has ended reads no more. That is no reason for the test to end.
  sigset_t pipe;
  sigset_t before;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &pipe, &before);
  int failure = 0;
  for (std::size_t written = 0; written < text.size() && failure == 0;) {
    const ssize_t length = ::write(in_, text.data() + written, text.size() - written);
    if (length >= 0) {
      written += static_cast<std::size_t>(length);
    } else if (errno != EINTR) {
      failure = errno;
    }
  }
  if (failure == EPIPE) {
    const timespec at_once{};
    sigtimedwait(&pipe, nullptr, &at_once);
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (failure != 0 && failure != EPIPE) {
    throw std::system_error(failure, std::generic_category(), "write to the command");
  }
}

void RunningCommand::close_input() {
  close_fd(in_);
}

void RunningCommand::send_signal(int number) {
  syscall(SYS_pidfd_send_signal, pidfd_, number, nullptr, 0);
}

CommandResult RunningCommand::wait(milliseconds timeout) {
  if (ended_) {
    return result_;
  }
  const auto deadline = Clock::now() + timeout;
  while (read_some(until(deadline))) {
    if (Clock::now() < deadline) {
      continue;
    }
    result_.timed_out = true;
    kill(-pid_, SIGKILL);
    break;
  }
  reap();
  drain();
  result_.output_closed = out_ < 0 && err_ < 0;
  return result_;
}

bool RunningCommand::read_some(milliseconds timeout) {
  // A closed pipe has descriptor -1, which poll() skips.
  std::array<pollfd, 3> fds = {pollfd{out_, POLLIN, 0}, pollfd{err_, POLLIN, 0}, pollfd{pidfd_, POLLIN, 0}};
  if (poll(fds.data(), fds.size(), static_cast<int>(timeout.count())) < 0) {
    return errno == EINTR;
  }
  drain();
  return fds[2].revents == 0;
}

void RunningCommand::drain() {
  read_available(out_, result_.out);
  read_available(err_, result_.err);
}

void RunningCommand::reap() {
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  ended_ = true;
  if (WIFEXITED(status)) {
    result_.exit_code = WEXITSTATUS(status);
  }
  if (WIFSIGNALED(status)) {
    result_.signal = WTERMSIG(status);
  }
}

CommandResult run_command(const Command& command, milliseconds timeout, const std::string& input) {
  RunningCommand running(command);
  running.write(input);
  running.close_input();
  return running.wait(timeout);
}

CommandResult run_command(const std::vector<std::string>& argv) {
  return run_command(Command{.argv = argv});
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!(text << file.rdbuf()) && !std::filesystem::exists(path)) {
    throw std::runtime_error("cannot read " + path.string());
  }
  return text.str();
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  if (!(file << text).flush()) {
    throw std::runtime_error("cannot write " + path.string());
  }
}

}  // namespace test_support
