// SPDX-License-Identifier: Apache-2.0
// Errors of the commands and of their command lines, in one form for all:
//
//   launch check: error: unknown option '--formt'
//         = help: did you mean '--format'?
//         = help: see 'launch check --help'
//
// An error that has a place in a file begins with it (diagnostic.hpp). Exit codes are 1 after an error and 2 after a
// wrong command line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace launch {

constexpr int kWrongCommandLine = 2;  // exit code

// The whole text of an error. `command` is "launch check"; `help` may be empty.
std::string command_error(std::string_view command, std::string_view message, std::string_view help = {});

// The same for a wrong command line: the last line points to the help of the command.
std::string usage_error(std::string_view command, std::string_view message, std::string_view help = {});

// What a command takes, as far as a mistyped word may have meant it.
struct KnownWords {
  std::vector<std::string> options;   // "-f", "--format"
  std::vector<std::string> commands;  // what may follow the name of the command: "start"
};

// The error for words that a command does not take. `message` is used if they look like no mistyped ones.
std::string unexpected_word_error(std::string_view command, const std::vector<std::string>& words,
                                  const KnownWords& known, std::string_view message);

// The error for words that a command takes, with CLI11's sentence. A value that is none of a list gets a suggestion.
std::string wrong_value_error(std::string_view command, std::string_view message);

// The error that CLI11 has thrown for `app`, or for the subcommand of it that was given. A template, so that this
// library does not need CLI11.
template <typename App, typename Error>
std::string usage_error_of(const App& app, const Error& error) {
  const auto given = app.get_subcommands();
  const App& chosen = given.empty() ? app : *given.front();
  const std::string command = given.empty() ? app.get_name() : app.get_name() + " " + chosen.get_name();
  if (app.remaining(true).empty()) {
    return wrong_value_error(command, error.what());
  }
  KnownWords known;
  for (const auto* const option : chosen.get_options({})) {
    for (const std::string& name : option->get_lnames()) {
      known.options.push_back("--" + name);
    }
    for (const std::string& name : option->get_snames()) {
      known.options.push_back("-" + name);
    }
  }
  for (const auto* const subcommand : chosen.get_subcommands({})) {
    known.commands.push_back(subcommand->get_name());
  }
  return unexpected_word_error(command, app.remaining(true), known, error.what());
}

}  // namespace launch
