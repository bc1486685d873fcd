// SPDX-License-Identifier: Apache-2.0
// The other side of `--on`: runs a command for the side that has connected, and ends it when the connection ends.
#include <errno.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <string_view>
#include <utility>

#include "base/diagnostics/command_error.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/files/pipe.hpp"
#include "base/processes/spawn.hpp"
#include "programs/launch/remote/on_option.hpp"
#include "programs/launch/remote/remote_messages.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

constexpr int kRemoteExitOfSignal = 128;  // plus its number, as shells count
constexpr std::size_t kMostTyped = std::size_t{64} * 1024;

// The end of the connection is the end of standard input, and the command must be ended then. A connecting command such
// as sudo(8) leaves this process in the foreground of the terminal on the other side, where Ctrl-C would end it before.
constexpr std::array<int, 4> kIgnored = {SIGPIPE, SIGHUP, SIGINT, SIGQUIT};

winsize window_of(const TerminalSize& size) {
  winsize window{};
  window.ws_row = static_cast<unsigned short>(size.lines);
  window.ws_col = static_cast<unsigned short>(size.columns);
  return window;
}

// A terminal would change bytes of messages, and echo them: `ssh -t` and `docker exec -t` make one.
void make_raw(int fd) {
  termios modes{};
  if (::tcgetattr(fd, &modes) == 0) {
    ::cfmakeraw(&modes);
    ::tcsetattr(fd, TCSANOW, &modes);
  }
}

class OtherSide {
 public:
  // Returns when the command has ended, or when nobody is connected any more.
  void run();

 private:
  bool receive();
  void obey(const RemoteMessage& message);
  void begin(const RemoteRequest& request);
  void begin_on_terminal(const TerminalSize& size, std::vector<std::string> argv);
  bool pass_on(UniqueFd& from, RemoteKind kind);
  void write_typed();
  void finish();
  void end_command() const;

  RemoteMessages messages_;
  pid_t command_ = -1;
  UniqueFd ended_;  // of the command
  UniqueFd output_;
  UniqueFd errors_;
  UniqueFd input_;     // of a command without a terminal, if it gets one
  std::string typed_;  // that it has not taken
  bool input_ends_ = false;
  bool has_terminal_ = false;
  bool connected_ = true;
};

void OtherSide::run() {
  while (connected_) {
    // Of the connection, the end is told in any case.
    const bool may_receive = typed_.size() < kMostTyped;
    std::array<pollfd, 5> waits{{{STDIN_FILENO, static_cast<short>(may_receive ? POLLIN : 0), 0},
                                 {output_.get(), POLLIN, 0},
                                 {errors_.get(), POLLIN, 0},
                                 {ended_.get(), POLLIN, 0},
                                 {typed_.empty() ? -1 : input_.get(), POLLOUT, 0}}};
    if (::poll(waits.data(), waits.size(), -1) < 0) {
      continue;  // a signal
    }
    if (waits[4].revents != 0) {
      write_typed();
    }
    connected_ = (waits[0].revents == 0 || receive()) &&
                 (waits[1].revents == 0 || pass_on(output_, RemoteKind::kOutput)) &&
                 (waits[2].revents == 0 || pass_on(errors_, RemoteKind::kError));
    if (connected_ && waits[3].revents != 0) {
      finish();
      return;
    }
  }
  end_command();
}

bool OtherSide::receive() {
  std::array<char, 4096> bytes;  // not initialised: it is read into
  const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
  if (count <= 0) {
    return count < 0 && errno == EINTR;
  }
  messages_.add(std::string_view(bytes.data(), static_cast<std::size_t>(count)));
  while (const auto message = messages_.take()) {
    obey(*message);
  }
  return true;
}

void OtherSide::obey(const RemoteMessage& message) {
  switch (message.kind) {
    case RemoteKind::kRequest:
      if (command_ < 0) {
        begin(parse_remote_request(message.content));
      }
      break;
    case RemoteKind::kInput:
      if (has_terminal_) {
        write_all(output_.get(), message.content);
      } else {
        typed_ += message.content;
        input_ends_ = input_ends_ || message.content.empty();
        write_typed();
      }
      break;
    case RemoteKind::kSize:
      if (has_terminal_) {
        const winsize window = window_of(parse_size(message.content));
        ::ioctl(output_.get(), TIOCSWINSZ, &window);
      }
      break;
    case RemoteKind::kSignal:
      if (command_ > 0) {
        ::kill(-command_, std::atoi(message.content.c_str()));
      }
      break;
    default:  // of a later version
      break;
  }
}

void OtherSide::begin(const RemoteRequest& request) {
  for (const auto& [name, value] : request.environment) {
    ::setenv(name.c_str(), value.c_str(), 1);
  }
  std::vector<std::string> argv = request.words;
  argv.insert(argv.begin(), "launch");
  if (request.terminal) {
    begin_on_terminal(*request.terminal, std::move(argv));
  } else {
    Pipe input = make_pipe();
    Pipe output = make_pipe();
    Pipe errors = make_pipe();
    command_ = spawn({.program = own_prefix() + "/bin/launch",
                      .argv = std::move(argv),
                      .descriptors = {{STDIN_FILENO, request.input ? input.read.get() : kDevNull},
                                      {STDOUT_FILENO, output.write.get()},
                                      {STDERR_FILENO, errors.write.get()}},
                      .only_given_descriptors = true,
                      .group = ChildGroup::kOwn,
                      .signals = ChildSignals::kFresh});
    if (request.input && ::fcntl(input.write.get(), F_SETFL, O_NONBLOCK) == 0) {
      input_ = std::move(input.write);
    }
    output_ = std::move(output.read);
    errors_ = std::move(errors.read);
  }
  ended_.reset(static_cast<int>(::syscall(SYS_pidfd_open, command_, 0)));
}

// The command leads the foreground of the terminal, so that Ctrl-C and a new size reach it. This process has one
// thread.
void OtherSide::begin_on_terminal(const TerminalSize& size, std::vector<std::string> argv) {
  const std::string program = own_prefix() + "/bin/launch";
  std::vector<char*> pointers;
  for (std::string& word : argv) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  const winsize window = window_of(size);
  int terminal = -1;
  command_ = ::forkpty(&terminal, nullptr, nullptr, &window);
  if (command_ == 0) {
    for (const int signal : kIgnored) {
      ::signal(signal, SIG_DFL);
    }
    ::execv(program.c_str(), pointers.data());
    ::_exit(127);
  }
  if (command_ < 0) {
    throw std::system_error(errno, std::system_category(), "can't make a terminal");
  }
  output_.reset(terminal);
  has_terminal_ = true;
}

// False when nobody is connected any more. A descriptor that has ended is closed.
bool OtherSide::pass_on(UniqueFd& from, RemoteKind kind) {
  std::array<char, 16UL << 10U> bytes;  // not initialised: it is read into
  const ssize_t count = ::read(from.get(), bytes.data(), bytes.size());
  if (count > 0) {
    return write_all(STDOUT_FILENO, encode(kind, std::string_view(bytes.data(), static_cast<std::size_t>(count))));
  }
  if (count == 0 || errno != EINTR) {
    from.reset();
  }
  return true;
}

void OtherSide::write_typed() {
  while (input_ && !typed_.empty()) {
    const ssize_t count = ::write(input_.get(), typed_.data(), typed_.size());
    if (count < 0 && errno == EAGAIN) {
      return;
    }
    if (count < 0 && errno != EINTR) {
      input_.reset();  // nobody reads it
    }
    typed_.erase(0, static_cast<std::size_t>(count < 0 ? 0 : count));
  }
  if (!input_ || input_ends_) {
    input_.reset();
    typed_.clear();
  }
}

// What the command has left in its pipes, then its exit code. A process that it has left may hold the pipes open.
void OtherSide::finish() {
  for (const auto& [fd, kind] : {std::pair(&output_, RemoteKind::kOutput), std::pair(&errors_, RemoteKind::kError)}) {
    pollfd readable{fd->get(), POLLIN, 0};
    while (*fd && ::poll(&readable, 1, 0) > 0 && pass_on(*fd, kind)) {
    }
  }
  const int status = wait_for(command_);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : kRemoteExitOfSignal + WTERMSIG(status);
  write_all(STDOUT_FILENO, encode(RemoteKind::kExit, std::to_string(code)));
}

void OtherSide::end_command() const {
  if (command_ <= 0) {
    return;
  }
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    ::kill(-command_, signal);
    if (ends_within(command_, 1s)) {
      break;
    }
  }
  wait_for(command_);
}

}  // namespace

int remote_side_command(const std::vector<std::string>& words) {
  if (!words.empty()) {
    fmt::print(stderr, "{}", usage_error("launch remote-side", "takes no words"));
    return kWrongCommandLine;
  }
  for (const int signal : kIgnored) {
    ::signal(signal, SIG_IGN);
  }
  ::unsetenv("LAUNCH_ON");
  make_raw(STDIN_FILENO);
  if (!write_all(STDOUT_FILENO, greeting_line(LAUNCH_VERSION))) {
    return 1;
  }
  OtherSide().run();
  return 0;
}

}  // namespace launch
