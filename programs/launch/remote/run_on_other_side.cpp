// SPDX-License-Identifier: Apache-2.0
// This side of `--on`: starts the connecting command, and shows what the command on the other side prints.
#include <errno.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "base/diagnostics/command_error.hpp"
#include "base/diagnostics/diagnostic.hpp"
#include "base/environment/own_environment.hpp"
#include "base/files/pipe.hpp"
#include "base/processes/ending_signals.hpp"
#include "base/processes/spawn.hpp"
#include "base/terminal/detach_keys.hpp"
#include "base/terminal/raw_terminal.hpp"
#include "base/terminal/terminal.hpp"
#include "launcher/substitution/template_parser.hpp"
#include "programs/launch/remote/on_option.hpp"
#include "programs/launch/remote/remote_messages.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

// What the terminal here can show.
constexpr std::array<const char*, 6> kTerminalVariables = {"TERM", "COLORTERM", "NO_COLOR",
                                                           "LANG", "LC_ALL",    "LC_CTYPE"};
constexpr char kControlC = 3;
constexpr std::chrono::seconds kDetachPatience{3};
constexpr int kOften = 100;  // milliseconds

class ThisSide {
 public:
  // With `detach_keys`, all keys are for what runs on the other side: these alone may end this side.
  ThisSide(std::string command, std::string connect, std::optional<DetachKeys> detach_keys)
      : command_(std::move(command)), connect_(std::move(connect)), detach_keys_(std::move(detach_keys)) {}

  int run(const std::vector<std::string>& argv, RemoteRequest request);

 private:
  void connect(const std::vector<std::string>& argv);
  void follow();
  void receive();
  void take_greeting();
  void obey(const RemoteMessage& message);
  void take_keys();
  void send_input();
  void take_signal();
  void send(RemoteKind kind, std::string_view content);
  int end_of_connection();
  int report(int status) const;

  std::string command_;
  std::string connect_;
  pid_t pid_ = -1;
  UniqueFd to_;
  UniqueFd from_;
  UniqueFd signals_;
  UniqueFd ended_;  // of the connecting command
  RemoteRequest request_;
  std::string before_;  // what came before the greeting
  bool greeted_ = false;
  bool strange_ = false;       // what came are no messages
  std::string other_version_;  // of a launch there that this one can't talk with
  std::optional<RawTerminal> raw_;
  bool interrupted_ = false;  // by a key
  bool sends_input_ = false;  // what is read here, without a terminal
  bool can_send_ = false;     // a piece of it, without waiting
  std::optional<DetachKeys> detach_keys_;
  std::optional<std::chrono::steady_clock::time_point> leaves_at_;  // even if the other side does not answer
  RemoteMessages messages_;
  std::optional<int> exit_code_;
  int signal_ = 0;  // that has ended this side
};

int ThisSide::run(const std::vector<std::string>& argv, RemoteRequest request) {
  request_ = std::move(request);
  connect(argv);
  follow();
  if (raw_ && !exit_code_ && takes_control_sequences(STDOUT_FILENO)) {
    // The command there has not set the screen back: the normal one, a cursor, no colours.
    write_all(STDOUT_FILENO, "\033[?1049l\033[?25h\033[0m\r\n");
  }
  raw_.reset();
  const int code = end_of_connection();
  if (signal_ != 0) {
    ::signal(signal_, SIG_DFL);
    sigset_t only;
    sigemptyset(&only);
    sigaddset(&only, signal_);
    ::raise(signal_);
    ::sigprocmask(SIG_UNBLOCK, &only, nullptr);
  }
  return code;
}

// It stays in our process group: it may ask for a password on this terminal, and Ctrl-C is for it, too.
void ThisSide::connect(const std::vector<std::string>& argv) {
  ::signal(SIGPIPE, SIG_IGN);
  sigset_t taken;
  sigemptyset(&taken);
  for (const int signal : kEndingSignals) {
    sigaddset(&taken, signal);
  }
  sigaddset(&taken, SIGWINCH);
  ::sigprocmask(SIG_BLOCK, &taken, nullptr);
  signals_.reset(::signalfd(-1, &taken, SFD_CLOEXEC));
  Pipe input = make_pipe();
  Pipe output = make_pipe();
  pid_ = spawn({.program = argv.front(),
                .argv = argv,
                .search_path = true,
                .descriptors = {{STDIN_FILENO, input.read.get()}, {STDOUT_FILENO, output.write.get()}},
                .signals = ChildSignals::kFresh});
  ended_.reset(static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0)));
  to_ = std::move(input.write);
  from_ = std::move(output.read);
}

void ThisSide::follow() {
  while (from_ && !exit_code_ && signal_ == 0) {
    std::array<pollfd, 5> waits{{{from_.get(), POLLIN, 0},
                                 {signals_.get(), POLLIN, 0},
                                 {raw_ || can_send_ ? STDIN_FILENO : -1, POLLIN, 0},
                                 {ended_.get(), POLLIN, 0},
                                 {sends_input_ && !can_send_ ? to_.get() : -1, POLLOUT, 0}}};
    if (leaves_at_ && std::chrono::steady_clock::now() >= *leaves_at_) {
      break;
    }
    if (::poll(waits.data(), waits.size(), leaves_at_ ? kOften : -1) < 0) {
      continue;
    }
    if (waits[0].revents != 0) {
      receive();
    } else if (waits[3].revents != 0) {
      from_.reset();  // a process that the connecting command has left may hold the pipe open
    }
    if (waits[1].revents != 0) {
      take_signal();
    }
    can_send_ = can_send_ || waits[4].revents != 0;
    if (waits[2].revents != 0) {
      if (raw_) {
        take_keys();
      } else {
        send_input();
      }
    }
  }
}

void ThisSide::receive() {
  std::array<char, 64UL << 10U> bytes;  // not initialised: it is read into
  const ssize_t count = ::read(from_.get(), bytes.data(), bytes.size());
  if (count <= 0) {
    from_.reset();
    return;
  }
  const std::string_view text(bytes.data(), static_cast<std::size_t>(count));
  if (greeted_) {
    messages_.add(text);
  } else {
    before_ += text;
    take_greeting();
  }
  try {
    while (const auto message = greeted_ ? messages_.take() : std::nullopt) {
      obey(*message);
    }
  } catch (const std::runtime_error&) {
    strange_ = true;
    from_.reset();
  }
}

// Passes over what a login prints.
void ThisSide::take_greeting() {
  constexpr std::size_t kMost = 64UL << 10U;
  std::size_t begin = 0;
  for (std::size_t end; (end = before_.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const auto greeting = parse_greeting(std::string_view(before_).substr(begin, end - begin));
    if (!greeting) {
      continue;
    }
    greeted_ = true;
    messages_.add(std::string_view(before_).substr(end + 1));
    before_.clear();
    if (greeting->version != kRemoteVersion) {
      other_version_ = greeting->launch_version;
      from_.reset();
    } else if (greeting->launch_version != LAUNCH_VERSION) {
      fmt::print(stderr, "{}: warning: launch has version {} on the other side, and {} here\n", command_,
                 greeting->launch_version, LAUNCH_VERSION);
    }
    if (request_.terminal) {
      raw_.emplace();
    }
    sends_input_ = request_.input;
    send(RemoteKind::kRequest, to_text(request_));
    return;
  }
  if (before_.size() > kMost) {
    before_.erase(0, before_.size() - kMost / 2);
  }
}

void ThisSide::obey(const RemoteMessage& message) {
  switch (message.kind) {
    case RemoteKind::kOutput:
      if (!write_all(STDOUT_FILENO, message.content)) {
        signal_ = SIGPIPE;  // `launch logs -f --on … | head` ends quietly
      }
      break;
    case RemoteKind::kError:
      write_all(STDERR_FILENO, message.content);
      break;
    case RemoteKind::kExit:
      exit_code_ = std::atoi(message.content.c_str());
      break;
    default:  // of a later version
      break;
  }
}

// The first Ctrl-C is for the command there, which then sets its screen back. If there is no answer, the second one
// ends the connection. The keys that detach are for the command there, too, and end the connection if it hangs.
void ThisSide::take_keys() {
  std::array<char, 4096> keys{};
  const ssize_t count = ::read(STDIN_FILENO, keys.data(), keys.size());
  if (count <= 0) {
    signal_ = SIGHUP;  // the terminal has gone
    return;
  }
  const std::string_view typed(keys.data(), static_cast<std::size_t>(count));
  if (detach_keys_) {
    if (detach_keys_->add(typed).detached) {
      leaves_at_ = std::chrono::steady_clock::now() + kDetachPatience;
    }
  } else if (typed.find(kControlC) != std::string_view::npos && std::exchange(interrupted_, true)) {
    signal_ = SIGINT;
    return;
  }
  send(RemoteKind::kInput, typed);
}

// The other side may not take it now, and signals must be seen meanwhile. So a piece follows when the pipe has room.
void ThisSide::send_input() {
  std::array<char, 4000> bytes{};  // with what is in front, less than PIPE_BUF
  const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) {
    return;
  }
  sends_input_ = count > 0;
  can_send_ = false;
  send(RemoteKind::kInput, std::string_view(bytes.data(), static_cast<std::size_t>(count > 0 ? count : 0)));
}

void ThisSide::take_signal() {
  signalfd_siginfo info{};
  if (::read(signals_.get(), &info, sizeof info) != static_cast<ssize_t>(sizeof info)) {
    return;
  }
  const int signal = static_cast<int>(info.ssi_signo);
  if (signal == SIGWINCH) {
    if (raw_) {
      send(RemoteKind::kSize, to_text(terminal_size(STDOUT_FILENO)));
    }
    return;
  }
  if (greeted_) {
    send(RemoteKind::kSignal, std::to_string(signal));
  }
  signal_ = signal;
}

void ThisSide::send(RemoteKind kind, std::string_view content) {
  write_all(to_.get(), encode(kind, content));  // if nobody reads it, the end of the connection comes next
}

// Lets the connecting command end by itself, and returns the exit code.
int ThisSide::end_of_connection() {
  constexpr std::chrono::seconds kPatience{3};
  to_.reset();
  from_.reset();
  if (signal_ != 0 && signal_ != SIGPIPE && !ends_within(pid_, 500ms)) {
    ::kill(pid_, signal_);
  }
  for (const int signal : {SIGTERM, SIGKILL}) {
    if (ends_within(pid_, kPatience)) {
      break;
    }
    ::kill(pid_, signal);
  }
  const int status = wait_for(pid_);
  // Ctrl-C has ended the connecting command as well, and its end was seen first.
  pollfd signalled{signals_.get(), POLLIN, 0};
  while (!exit_code_ && signal_ == 0 && ::poll(&signalled, 1, 0) > 0) {
    take_signal();
  }
  return exit_code_ ? *exit_code_ : signal_ != 0 ? kNoConnection : report(status);
}

int ThisSide::report(int status) const {
  const std::string how = WIFEXITED(status) ? fmt::format("ended with exit code {}", WEXITSTATUS(status))
                                            : fmt::format("was ended by SIG{}", ::sigabbrev_np(WTERMSIG(status)));
  write_all(STDERR_FILENO, before_);
  if (!before_.empty() && !before_.ends_with('\n')) {
    write_all(STDERR_FILENO, "\n");
  }
  std::string what = fmt::format("'{}' {} before launch answered there", connect_, how);
  std::string help =
      fmt::format("see what '{} launch --version' prints; it must be {} or later", connect_, LAUNCH_VERSION);
  if (!other_version_.empty()) {
    what = fmt::format("launch {} on the other side of '{}' and {} here can't talk with each other", other_version_,
                       connect_, LAUNCH_VERSION);
    help = "install the same version on both sides";
  } else if (strange_) {
    what = fmt::format("launch on the other side of '{}' sends what is no message of launch", connect_);
  } else if (leaves_at_) {
    what = fmt::format("launch on the other side of '{}' does not answer", connect_);
    help = "the process there goes on";
  } else if (greeted_) {
    what = fmt::format("the connection has ended: '{}' {}", connect_, how);
    help = "what was asked for may have happened";
  } else if (WIFEXITED(status) && (WEXITSTATUS(status) == 127 || WEXITSTATUS(status) == 126)) {
    what = fmt::format("there is no program 'launch' in the PATH on the other side of '{}'", connect_);
    help =
        fmt::format("install it there, or say where it is: --on '{} env PATH=/opt/launch/bin:/usr/bin:/bin'", connect_);
  } else if (WIFEXITED(status) && WEXITSTATUS(status) == kNoConnection) {
    what = fmt::format("no connection: '{}' {}", connect_, how);
    help = fmt::format("see whether '{} true' works", connect_);
  }
  fmt::print(stderr, "{}", command_error(command_, what, help));
  return kNoConnection;
}

}  // namespace

int run_on_other_side(const std::string& command, const std::string& connect, std::vector<std::string> words,
                      OtherTerminal terminal) {
  std::vector<std::string> argv;
  try {
    argv = split_shell_words(connect, {});
  } catch (const LaunchError& error) {
    fmt::print(stderr, "{}",
               usage_error(command, fmt::format("--on \"{}\": {}", connect, error.diagnostics().front().message)));
    return kWrongCommandLine;
  }
  if (argv.empty()) {
    fmt::print(stderr, "{}", usage_error(command, "--on needs a command, such as 'ssh robot'"));
    return kWrongCommandLine;
  }
  const bool only_shows = std::find(words.begin(), words.end(), "--no-stdin") != words.end();
  std::optional<DetachKeys> detach_keys;
  if (terminal == OtherTerminal::kOfProcess) {
    detach_keys = detach_keys_of(words);
  }
  // Blanks and quotes of words would not survive: ssh(1) joins them, and a shell reads them there. These two do.
  argv.insert(argv.end(), {"launch", "remote-side"});
  RemoteRequest request{.words = std::move(words), .environment = {}, .terminal = std::nullopt};
  const Environment environment = own_environment();
  for (const char* const name : kTerminalVariables) {
    if (const auto found = environment.find(name); found != environment.end()) {
      request.environment.emplace(name, found->second);
    }
  }
  if (terminal != OtherTerminal::kNone && ::isatty(STDIN_FILENO) != 0 && ::isatty(STDOUT_FILENO) != 0) {
    request.terminal = terminal_size(STDOUT_FILENO);
  }
  request.input = terminal == OtherTerminal::kOfProcess && !request.terminal && !only_shows;
  try {
    return ThisSide(command, connect, std::move(detach_keys)).run(argv, std::move(request));
  } catch (const SpawnError& error) {
    fmt::print(stderr, "{}", command_error(command, error.what(), "--on needs a command, such as 'ssh robot'"));
    return kNoConnection;
  }
}

}  // namespace launch
