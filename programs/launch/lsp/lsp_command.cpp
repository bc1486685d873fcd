// SPDX-License-Identifier: Apache-2.0
// `launch lsp`: the language server of launch files, which editors start.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>

#include "base/diagnostics/command_error.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/lsp/server.hpp"

namespace launch {

int lsp_command(const Words& words) {
  lsp::ServerOptions options;
  bool stdio = false;
  Subcommand command(
      "launch lsp",
      "The language server of launch files, for editors: diagnostics, completion, help, places. Speaks the "
      "Language Server Protocol on standard input and output. docs/editors.md tells how to set an editor up.");
  command.take_flag("--run-python", options.runs_python,
                    "run Python launch files when they are opened or saved, in a process of their own, to find their "
                    "errors and arguments");
  command.take_flag("--check-folder", options.checks_folder,
                    "check all XML and YAML launch files of the folder, also those that are not open");
  command.take_text(
      "--from-trace", options.trace,
      "the directory of a recorded run, whose nodes and topics are completed, and remaps checked against");
  command.take_flag("--stdio", stdio, "accepted, as editors give it; there is no other way");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  try {
    return lsp::Server(options, STDIN_FILENO, STDOUT_FILENO).run();
  } catch (const std::runtime_error& error) {
    fmt::print(stderr, "{}", command_error("launch lsp", error.what()));
    return 1;
  }
}

}  // namespace launch
