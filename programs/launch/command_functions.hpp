// SPDX-License-Identifier: Apache-2.0
// The functions behind the rows of command_table.cpp.
//
// Those that run a command take the words behind its name. They return the exit code: 0, 1 after an error, 2 for a
// wrong command line, or what the command's man page says. Those for the shells' completion take all words after
// `launch` and return what may stand in the place of the last one.
#pragma once

#include "base/environment/environment.hpp"
#include "programs/launch/commands.hpp"

namespace launch {

int check_command(const Words& words);
int explain_command(const Words& words);
int convert_command(const Words& words);
int export_command(const Words& words);
int format_command(const Words& words);
int graph_command(const Words& words);
int lsp_command(const Words& words);
int migrate_command(const Words& words);
int reference_command(const Words& words);
int run_program_command(const Words& words);  // `launch run`
int schema_command(const Words& words);
int unit_command(const Words& words);
int doctor_command(const Words& words);

// These ask a running launch, and throw ControlError.
int attach_command(const Words& words);
int gdb_command(const Words& words);
int stack_command(const Words& words);
int events_command(const Words& words);
int logs_command(const Words& words);
int ps_command(const Words& words);
int reload_command(const Words& words);
int restart_command(const Words& words);
int scale_command(const Words& words);
int shutdown_command(const Words& words);
int signal_command(const Words& words);
int start_command(const Words& words);
int stop_command(const Words& words);
int top_command(const Words& words);

// Starts `launch` with these words in the background, and shows it in `launch top`. When the view is left, the lines of
// the launch follow on the terminal. SIGINT and other signals that end this process end the launch instead. Returns the
// exit code of the launch.
int launch_in_top(Words words, const Environment& environment);

// The help of their option --launch.
inline constexpr const char* kLaunchHelp = "number or file of the launch, if several run";

Words attach_words(const Words& words);       // names of processes with a terminal
Words finding_words(const Words& words);      // ids
Words launch_file_words(const Words& words);  // launch files, packages, arguments and their values
Words process_words(const Words& words);  // names of the processes of the launches that run, behind --group of groups
Words run_program_words(const Words& words);  // packages, programs, and options
Words scale_words(const Words& words);        // names of processes that are scalable
Words schema_words(const Words& words);       // formats
Words unit_words(const Words& words);         // verbs, then what a launch takes, or units
Words signal_words(const Words& words);       // a process, then a signal

}  // namespace launch
