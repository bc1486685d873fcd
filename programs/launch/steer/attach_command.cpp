// SPDX-License-Identifier: Apache-2.0
// `launch attach`: connects this terminal with that of a process of a running launch.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstdio>

#include "base/diagnostics/diagnostic.hpp"
#include "base/environment/own_environment.hpp"
#include "base/processes/process_mark.hpp"
#include "base/terminal/terminal.hpp"
#include "launcher/control/control_client.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/remote/on_option.hpp"
#include "programs/launch/steer/attached_terminal.hpp"
#include "programs/launch/steer/process_text.hpp"

namespace launch {
namespace {

using Json = ControlClient::Json;

constexpr int kExitOfSignal = 128;  // plus its number, as shells count

// A process that is attached to its own terminal would read what it prints, for ever.
bool is_this_terminal(const std::string& terminal) {
  std::array<char, 256> name{};
  return own_environment().contains(kMarkVariable) && !terminal.empty() &&
         ::ttyname_r(STDOUT_FILENO, name.data(), name.size()) == 0 && terminal == name.data();
}

std::string text_of_keys(const Json& answer, const DetachKeys& keys, bool read_only) {
  std::string text = fmt::format("launch attach: {}", answer.value("process", ""));
  if (const std::size_t others = answer.value("clients", std::size_t{0}); others > 0) {
    text += fmt::format(", {} attached as well", others == 1 ? "one other is" : fmt::format("{} others are", others));
  }
  const std::string leave = read_only ? "ctrl-c" : "";
  const std::string detach = keys.text();
  const std::string both = leave + (leave.empty() || detach.empty() ? "" : " or ") + detach;
  return both.empty() ? text : fmt::format("{}; {} detaches", text, both);
}

[[noreturn]] void end_by(int signal) {
  ::signal(signal, SIG_DFL);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  ::raise(signal);
  ::sigprocmask(SIG_UNBLOCK, &only, nullptr);
  ::_exit(kExitOfSignal + signal);
}

int exit_code_of(const Json& end) {
  return end.contains("signal") ? kExitOfSignal + signal_number(end["signal"].get<std::string>())
                                : end.value("exit_code", 1);
}

}  // namespace

int attach_command(const Words& words) {
  std::string name;
  std::string wanted;
  std::string keys_text = DetachKeys::kUsual;
  bool read_only = false;
  Subcommand command("launch attach",
                     "Connects this terminal with that of a process of a running launch, which has tty=\"true\" in the "
                     "launch file. The process goes on when this is left.");
  command.take_text("NAME", name, "name of a process or its node");
  command.take_text("--detach-keys", keys_text, "keys that leave the process: ctrl-p,ctrl-q; \"\" for none");
  command.take_flag("--no-stdin", read_only, "only show what the process prints");
  command.take_text("--launch", wanted, kLaunchHelp);
  describe_on_option(command);
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  if (name.empty()) {
    fmt::print(stderr, "{}", usage_error("launch attach", "NAME is required"));
    return kWrongCommandLine;
  }
  const std::optional<DetachKeys> keys = DetachKeys::parse(keys_text);
  if (!keys) {
    fmt::print(stderr, "{}",
               usage_error("launch attach", fmt::format("--detach-keys: '{}' names no keys", keys_text),
                           "write keys with commas between, such as ctrl-a,d"));
    return kWrongCommandLine;
  }
  ControlClient launch = choose_launch(own_environment(), wanted);
  const TerminalSize size = ::isatty(STDOUT_FILENO) != 0 ? terminal_size(STDOUT_FILENO) : TerminalSize();
  const Json answer = launch.ask({{"do", "attach"},
                                  {"processes", {name}},
                                  {"columns", size.columns},
                                  {"lines", size.lines},
                                  {"read_only", read_only}});
  const std::string process = answer.value("process", "");
  if (is_this_terminal(answer.value("terminal", ""))) {
    throw ControlError(fmt::format("this terminal is that of '{}'", process), "attach from another one");
  }
  const bool has_terminal = ::isatty(STDIN_FILENO) != 0 && ::isatty(STDOUT_FILENO) != 0;
  const std::string greeting = has_terminal ? text_of_keys(answer, *keys, read_only) : "";
  const AttachedTerminal::End end = AttachedTerminal(launch, {read_only, *keys, greeting}).run();
  if (end.cut_line && ::isatty(STDOUT_FILENO) != 0) {
    fmt::print(stderr, "\n");
  }
  if (end.signal != 0) {
    end_by(end.signal);
  }
  if (end.detached) {
    fmt::print(stderr, "launch attach: detached, {} goes on\n", process);
    return 0;
  }
  if (!end.process) {
    throw ControlError(fmt::format("launch {} has ended", launch.pid()));
  }
  const bool is_known = end.process->contains("signal") || end.process->contains("exit_code");
  fmt::print(stderr, "launch attach: {} {}{}\n", process,
             is_known ? "has ended: " + end_text(*end.process) : std::string("does not end, it is left running"),
             end.process->value("will_respawn", false) ? "; it starts again" : "");
  return exit_code_of(*end.process);
}

}  // namespace launch
