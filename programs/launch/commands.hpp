// SPDX-License-Identifier: Apache-2.0
// The commands of the launcher, a row for each (command_table.cpp). What runs, the list in `launch --help`, the
// suggestions for mistyped commands, the shells' completion and the list of man pages all come from these rows.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "programs/launch/remote/on_option.hpp"

namespace launch {

using Words = std::vector<std::string>;

struct Command {
  const char* name;          // "check"; two words for a verb with a row of its own; "" runs launch files
  const char* operand = "";  // as `launch --help` shows it
  const char* help = "";     // its line in `launch --help`; "": not listed there

  // Runs it with the words behind the name, and returns the exit code. What it throws is told as an error of the
  // command, with exit code 1.
  int (*run)(const Words& words) = nullptr;
  // Or the program of lib/launch that the launcher becomes. The launcher links no libraries for reading traces and no
  // middleware, so other programs do what needs them.
  const char* program = nullptr;
  bool program_gets_name = false;  // it does several commands
  bool asks_nodes = false;         // the program may be that of a companion (launcher/ros/ros_program.hpp)

  bool asks_launch = false;  // it asks a running launch, and takes --on (remote/on_option.hpp)
  OtherTerminal other_terminal = OtherTerminal::kNone;  // what it wants there

  // Candidates for the last of the words after `launch`. They need not begin like this word. Null: only options.
  Words (*complete)(const Words& words) = nullptr;
  bool completes_options = false;  // `complete` offers the options, too; else those of the help are offered

  const char* exit_status = "0 without errors, 1 after an error, 2 after a wrong command line.";  // for the man page
  bool hidden = false;                                                                            // for programs only
};

const std::vector<Command>& command_table();

// The command that these words after `launch` begin with: the longest name.
const Command& find_command(const Words& words);

// Runs the command, or becomes its program. `words` are those after `launch`.
int run_command_of(const Words& words);

Words listed_command_names();

// "Other commands:" and a line for each.
std::string list_of_commands();

// What the shells' completion (programs/launch/completion/) offers for the last of these words after `launch`. It may
// be empty or incomplete. The shell itself completes names of files.
Words completions(const Words& words);

}  // namespace launch
