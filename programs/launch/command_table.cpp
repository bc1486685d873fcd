// SPDX-License-Identifier: Apache-2.0
// The rows of commands.hpp, in the order of `launch --help`.
#include <fmt/format.h>

#include <filesystem>
#include <sstream>
#include <utility>
#include <variant>

#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/ros/ros_program.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/completion/help_options.hpp"
#include "programs/launch/remote/on_option.hpp"
#include "programs/launch/run/command_line.hpp"
#include "programs/launch/run/run_command.hpp"
#include "programs/launch/trace/trace_command.hpp"

namespace launch {

namespace {

// `launch FILE`
int run_launch_files(const Words& words) {
  const auto parsed = parse_command_line(words);
  if (const auto* const exit_now = std::get_if<ExitNow>(&parsed)) {
    return exit_now->code;
  }
  const auto& command = std::get<CommandLine>(parsed);
  if (!command.top) {
    return run_command(command, own_environment());
  }
  Words others = words;
  std::erase(others, "--top");
  return launch_in_top(std::move(others), own_environment());
}

// `launch complete WORD …`: what the scripts in completion/ ask for.
int complete_command(const Words& words) {
  ResultOutput result("launch complete");
  for (const std::string& word : completions(words)) {
    result.print(word + "\n");
  }
  return result.finish() ? 0 : 1;
}

// `launch list-commands`: what has a man page, and the exit status for it (man/write_man_pages.py).
int list_commands(const Words& /*words*/) {
  for (const Command& command : command_table()) {
    if (!command.hidden && (command.program == nullptr || std::filesystem::exists(own_library_file(command.program)))) {
      fmt::print("{}\t{}{}\n", command.name, command.exit_status,
                 command.asks_launch ? " With --on, 255 if there is no connection." : "");
    }
  }
  return 0;
}

constexpr const char* kRosProgram = "launch-ros-command";

// It completes its own command lines.
Words ros_words(const Words& words) {
  Words argv = {"launch", "complete"};
  argv.insert(argv.end(), words.begin(), words.end());
  const std::string program = companion_program(kRosProgram, own_environment()).value_or(own_library_file(kRosProgram));
  std::istringstream lines(output_of(program, std::move(argv)));
  Words found;
  for (std::string line; std::getline(lines, line);) {
    found.push_back(line);
  }
  return found;
}

Command ros_command(const char* name, const char* operand, const char* help) {
  return {.name = name,
          .operand = operand,
          .help = help,
          .program = kRosProgram,
          .program_gets_name = true,
          .asks_nodes = true,
          .complete = ros_words,
          .completes_options = true};
}

Command without_nodes(Command command) {
  command.asks_nodes = false;
  return command;
}

Command asking(Command command) {
  command.asks_launch = true;
  return command;
}

constexpr const char* kLaunchStatus =
    "0 after a run in which nothing has failed, 1 after an error of the launch, 2 after a wrong command line, 3 "
    "if a process has failed, or a component could not be loaded; 128+N if a "
    "second signal N has cut the end short. If a process with \"required\" ended the system, the status is that "
    "of the process, or 128+N if signal N ended it.";
constexpr const char* kCheckStatus =
    "0 without errors, 1 when a launch file has an error, 2 after a wrong command line. With --werror, "
    "warnings are errors.";
constexpr const char* kConvertStatus =
    "0 when the new file is there, 1 after an error and when a part has no form in the other language, 2 after a wrong "
    "command line.";
constexpr const char* kRunStatus =
    "That of the program, or 128+N if signal N ended it; 1 if it could not be started, 2 after a wrong "
    "command line.";
constexpr const char* kAttachStatus =
    "That of the process, or 128+N if signal N ended it; 0 after the keys that detach, 1 after an error, 2 after a "
    "wrong command line.";
constexpr const char* kInHelpOfVerbs =
    "0 without errors, 1 after an error, 2 after a wrong command line. Of status: 0 if the launch is active, 3 if it "
    "is "
    "not, 4 if there is no such unit.";
constexpr const char* kInHelp = "";  // the help tells the exit status

}  // namespace

const std::vector<Command>& command_table() {
  static const std::vector<Command> commands = {
      {.name = "", .run = run_launch_files, .complete = launch_file_words, .exit_status = kLaunchStatus},
      ros_command("action", "VERB", "lists and describes actions, and sends goals"),
      {.name = "attach",
       .operand = "NAME",
       .help = "connects this terminal with that of a process of a running launch",
       .run = attach_command,
       .asks_launch = true,
       .other_terminal = OtherTerminal::kOfProcess,
       .complete = attach_words,
       .exit_status = kAttachStatus},
      {.name = "build", .operand = "PACKAGE", .help = "builds the packages of a workspace", .program = "launch-build"},
      {.name = "check",
       .operand = "FILE",
       .help = "finds errors without running anything",
       .run = check_command,
       .complete = launch_file_words,
       .exit_status = kCheckStatus},
      ros_command("clock", "", "publishes simulated time on /clock"),
      ros_command("component", "VERB", "lists, loads and unloads components"),
      {.name = "convert",
       .operand = "FILE",
       .help = "writes a launch file in XML, YAML or Python",
       .run = convert_command,
       .complete = launch_file_words,
       .exit_status = kConvertStatus},
      {.name = "doctor",
       .help = "tells what on this machine is in the way of real time, of tracing and of limits",
       .run = doctor_command,
       .exit_status = kInHelp},
      {.name = "events", .help = "prints what happens in a running launch", .run = events_command, .asks_launch = true},
      {.name = "explain",
       .operand = "ID",
       .help = "explains a finding of launch check or launch report",
       .run = explain_command,
       .complete = finding_words},
      {.name = "export",
       .operand = "FILE",
       .help = "makes of a launch file what systemd, Compose or Kubernetes runs",
       .run = export_command,
       .complete = launch_file_words},
      {.name = "format",
       .operand = "FILE",
       .help = "writes launch files in the form of the documentation",
       .run = format_command,
       .complete = launch_file_words,
       .exit_status = kInHelp},
      {.name = "gdb",
       .operand = "NAME",
       .help = "runs gdb on a process of a running launch",
       .run = gdb_command,
       .complete = process_words},
      {.name = "graph",
       .operand = "FILE",
       .help = "draws nodes, namespaces, includes and remapped topics",
       .run = graph_command,
       .complete = launch_file_words},
      without_nodes(ros_command("interface", "VERB", "shows the messages, services and actions that are installed")),
      ros_command("lifecycle", "VERB", "shows and changes the states of nodes with a life cycle"),
      asking(ros_command("loglevel", "NODE", "prints or sets the level of the loggers of nodes")),
      {.name = "logs",
       .operand = "NAME",
       .help = "prints what the processes of a running launch print",
       .run = logs_command,
       .asks_launch = true,
       .complete = process_words},
      {.name = "lsp", .operand = "", .help = "the language server of launch files, for editors", .run = lsp_command},
      {.name = "migrate",
       .operand = "FILE",
       .help = "writes a launch file of ROS 1 in the words of ROS 2",
       .run = migrate_command,
       .complete = launch_file_words,
       .exit_status = kInHelp},
      ros_command("node", "VERB", "lists and describes nodes"),
      ros_command("param", "VERB", "lists, prints and sets parameters of nodes"),
      {.name = "ps",
       .help = "lists the processes of the launches that run",
       .run = ps_command,
       .asks_launch = true,
       .complete = process_words},
      {.name = "reference", .help = "prints the reference of the launch language", .run = reference_command},
      {.name = "reload",
       .operand = "LAUNCH",
       .help = "lets a running launch read its launch file again",
       .run = reload_command,
       .asks_launch = true},
      {.name = "report",
       .operand = "DIR",
       .help = "describes a recorded trace",
       .program = "launch-report",
       .exit_status = kInHelp},
      {.name = "restart",
       .operand = "NAME",
       .help = "ends processes of a running launch and starts them again",
       .run = restart_command,
       .asks_launch = true,
       .complete = process_words},
      {.name = "run",
       .operand = "PKG PROGRAM",
       .help = "runs a program of a package on this terminal",
       .run = run_program_command,
       .complete = run_program_words,
       .completes_options = true,
       .exit_status = kRunStatus},
      {.name = "scale",
       .operand = "NAME N",
       .help = "lets so many of a process run that is scalable",
       .run = scale_command,
       .asks_launch = true,
       .complete = scale_words},
      {.name = "schema",
       .help = "prints a schema for editors, or that of the output for programs",
       .run = schema_command,
       .complete = schema_words},
      {.name = "serve", .help = "shows launches in a browser, and steers them there", .program = "launch-serve"},
      ros_command("service", "VERB", "lists, describes and calls services"),
      {.name = "shutdown", .help = "ends a running launch", .run = shutdown_command, .asks_launch = true},
      {.name = "signal",
       .operand = "NAME SIG",
       .help = "sends a signal to processes of a running launch",
       .run = signal_command,
       .asks_launch = true,
       .complete = signal_words},
      {.name = "stack",
       .operand = "NAME",
       .help = "prints what all threads of a process do now",
       .run = stack_command,
       .asks_launch = true,
       .complete = process_words},
      {.name = "start",
       .operand = "NAME",
       .help = "starts processes of a running launch that have ended",
       .run = start_command,
       .asks_launch = true,
       .complete = process_words},
      {.name = "stop",
       .operand = "NAME",
       .help = "ends processes of a running launch",
       .run = stop_command,
       .asks_launch = true,
       .complete = process_words},
      {.name = "test",
       .operand = "FILE",
       .help = "runs the tests of launch files",
       .program = "launch-test",
       .complete = launch_file_words},
      {.name = "top",
       .help = "shows the processes of a running launch on the whole screen",
       .run = top_command,
       .asks_launch = true,
       .other_terminal = OtherTerminal::kOfCommand,
       .complete = process_words},
      ros_command("topic", "VERB", "lists, prints, measures and publishes topics of ROS 2"),
      {.name = "trace",
       .operand = "…",
       .help = "records a trace by hand, or prints its events",
       .run = [](const Words& words) { return tracing::run_trace_command(words); },
       .complete =
           [](const Words& words) {
             return tracing::trace_completions({words.begin() + 1, words.end()});
           },
       .completes_options = true},
      {.name = "trace read", .program = "launch-trace-read", .exit_status = kInHelp},
      {.name = "twin",
       .operand = "DIR",
       .help = "makes stand-ins of a recorded system, and tells what would be if it were changed",
       .program = "launch-twin",
       .exit_status = kInHelp},
      {.name = "unit",
       .operand = "VERB",
       .help = "makes systemd start a launch with the machine",
       .run = unit_command,
       .complete = unit_words,
       .exit_status = kInHelpOfVerbs},
      {.name = "agent", .program = "launch-agent", .hidden = true},
      {.name = "complete", .run = complete_command, .hidden = true},
      {.name = "remote-side", .run = remote_side_command, .hidden = true},
      {.name = "list-commands", .run = list_commands, .hidden = true},
  };
  return commands;
}

}  // namespace launch
