// SPDX-License-Identifier: Apache-2.0
// `launch run PACKAGE PROGRAM [ARGUMENT …]`: runs a program of a package on this terminal, as `ros2 run` does, and ends
// what it has started when it ends. The exit code is that of the program, or 128+N if signal N ended it.
#include <fmt/format.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "base/diagnostics/diagnostic.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/processes/process_mark.hpp"
#include "base/processes/spawn.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/substitution/package_index.hpp"
#include "launcher/substitution/template_parser.hpp"
#include "launcher/visit/launch_context.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/run/run_command.hpp"

namespace launch {
namespace {

constexpr int kExitCodeOfSignal = 128;  // plus its number, as shells count
constexpr std::chrono::seconds kTimeout{5};

// The options end with the name of the program: all words behind it are its own.
struct OwnWords {
  std::vector<std::string> ours;
  std::vector<std::string> arguments;
};

OwnWords split(const std::vector<std::string>& words) {
  std::size_t names = 0;
  std::size_t i = 0;
  for (; i < words.size() && names < 2; ++i) {
    if (words[i] == "--prefix") {
      ++i;
    } else if (!words[i].starts_with("-")) {
      ++names;
    }
  }
  const auto end = words.begin() + static_cast<std::ptrdiff_t>(std::min(i, words.size()));
  return {{words.begin(), end}, {end, words.end()}};
}

std::string find_program(const std::string& package, const std::string& program, const Environment& environment) {
  PackageIndex packages(own_prefix());
  try {
    return packages.executable(program, package, environment);
  } catch (const std::runtime_error& error) {
    std::vector<std::string> programs;
    try {
      programs = packages.executables(package, environment);
    } catch (const std::runtime_error&) {
      throw LaunchError(error.what(), {}, packages.help_for_missing(package, environment));
    }
    throw LaunchError(error.what(), {}, did_you_mean(program, programs));
  }
}

// Waits for the program. Ctrl-C reaches it on its own, because it shares the terminal with this process. Other signals
// end it, with SIGTERM and SIGKILL after their timeouts.
class Wait {
 public:
  // To be made before the program starts: from now on signals wait for the loop.
  explicit Wait(EventLoop& loop)
      : loop_(loop), signals_(loop.on_signal({SIGINT, SIGTERM, SIGHUP, SIGQUIT}, [this](EventLoop::Signal signal) {
          const bool by_key = signal.by_terminal && signal.number != SIGHUP;
          if (!by_key) {
            end(signal.number);
          }
        })) {}

  int exit_code_of(pid_t pid) {
    pid_ = pid;
    const int pidfd = static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0));
    if (pidfd < 0) {
      throw std::system_error(errno, std::system_category(), "cannot open a descriptor for a process");
    }
    const UniqueFd owner(pidfd);
    const EventLoop::SourcePtr exit = loop_.on_exit(pidfd, [this] { loop_.quit(); });
    loop_.run();
    const int status = wait_for(pid_);
    return WIFSIGNALED(status) ? kExitCodeOfSignal + WTERMSIG(status) : WEXITSTATUS(status);
  }

 private:
  void end(int signal) {
    ::kill(pid_, signal);
    ::kill(pid_, SIGCONT);
    timer_ = loop_.after(kTimeout, [this] {
      ::kill(pid_, SIGTERM);
      timer_ = loop_.after(kTimeout, [this] { ::kill(pid_, SIGKILL); });
    });
  }

  EventLoop& loop_;
  pid_t pid_ = -1;
  EventLoop::SourcePtr signals_;
  EventLoop::SourcePtr timer_;
};

int run_on_terminal(const std::string& name, std::vector<std::string> argv, const Environment& environment) {
  std::vector<std::string> shown = {"launch", "run", name};
  Guardian guardian = Guardian::put_above(shown);
  const std::string mark = guardian.mark("launch", {});
  ::setenv(kMarkVariable, mark.c_str() + std::string_view(kMarkVariable).size() + 1, 1);
  for (const int signal : {SIGINT, SIGQUIT, SIGTERM}) {
    ::signal(signal, SIG_DFL);
  }
  const std::unique_ptr<EventLoop> loop = make_sd_event_loop();
  guardian.wait_until_ready();
  Wait wait(*loop);
  ProcessSpec spec;
  spec.name = name;
  spec.output = *OutputRouting::from_mode("screen");
  const std::string program = PackageIndex::find_on_path(argv.front(), environment);
  ChildProgram child{.program = program.empty() ? argv.front() : program,
                     .argv = std::move(argv),
                     .environment = &environment.variables(),
                     .mark = guardian.mark(name + "-1", spec),
                     .signals = ChildSignals::kFresh};
  return wait.exit_code_of(spawn(child));
}

// The program as the one process of a launch.
class RunProgram : public Action {
 public:
  RunProgram(SourceRange where, std::string name, std::vector<std::string> argv)
      : Action(std::move(where), Condition()), name_(std::move(name)), argv_(std::move(argv)) {}

 protected:
  void execute(LaunchContext& context) const override {
    ProcessSpec spec;
    spec.name = name_;
    spec.argv = argv_;
    spec.environment = context.scope().environment;
    spec.output = *OutputRouting::from_mode("both");
    spec.emulate_tty = ::isatty(STDOUT_FILENO) != 0;
    spec.required = true;
    context.requests().processes.push_back(std::move(spec));
  }

 private:
  std::string name_;
  std::vector<std::string> argv_;
};

int run_traced(const std::string& name, std::vector<std::string> argv, const Environment& environment) {
  auto description = std::make_shared<LaunchDescription>();
  description->file = std::make_shared<SourceFile>(name, "");
  description->actions.push_back(
      std::make_shared<RunProgram>(SourceRange(), std::filesystem::path(name).filename().string(), std::move(argv)));
  CommandLine command;
  command.words = {"launch", "run", "--trace", name};
  command.trace = true;
  return run_command(command, environment, std::move(description));
}

}  // namespace

int run_program_command(const std::vector<std::string>& words) {
  std::vector<std::string> names;
  std::string prefix;
  bool trace = false;
  Subcommand command(
      "launch run",
      "Runs a program of a package on this terminal, and ends what it leaves running when it ends. Words "
      "behind the name of the program are its arguments.");
  command.take_words("PACKAGE", names, true, "a package, one of its programs, and the arguments of the program");
  command.take_text("--prefix", prefix, "command line put in front, such as 'gdb -ex run --args'");
  command.take_flag("--trace", trace, "record a trace with the default settings; the program gets no terminal then");
  OwnWords own = split(words);
  if (const auto exit_code = command.parse(own.ours)) {
    return *exit_code;
  }
  if (names.size() < 2) {
    fmt::print(stderr, "{}",
               usage_error("launch run", "no program given", "launch run PACKAGE PROGRAM [ARGUMENT ...]"));
    return kWrongCommandLine;
  }
  const Environment environment = own_environment();
  std::vector<std::string> argv = split_shell_words(prefix, {});
  argv.push_back(find_program(names[0], names[1], environment));
  argv.insert(argv.end(), own.arguments.begin(), own.arguments.end());
  return trace ? run_traced(names[1], std::move(argv), environment)
               : run_on_terminal(names[1], std::move(argv), environment);
}

std::vector<std::string> run_program_words(const std::vector<std::string>& line) {
  const std::vector<std::string> words(line.begin() + 1, line.end());  // behind "run"
  if (!split({words.begin(), words.end() - 1}).arguments.empty()) {
    return {};
  }
  if (words.back().starts_with("-")) {
    return {"--help", "--prefix", "--trace"};
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (words[i] == "--prefix") {
      ++i;
    } else if (!words[i].starts_with("-")) {
      names.push_back(words[i]);
    }
  }
  const Environment environment = own_environment();
  PackageIndex packages(own_prefix());
  return names.empty()       ? packages.packages(environment)
         : names.size() == 1 ? packages.executables(names.front(), environment)
                             : std::vector<std::string>();
}

}  // namespace launch
