// SPDX-License-Identifier: Apache-2.0
// The command line of the commands that look at launch files without running them: check, graph, schema.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics/command_error.hpp"
#include "base/diagnostics/diagnostic.hpp"

namespace CLI {
class App;
}

namespace launch {

// Files, or a package and a file; and arguments, name:=value.
struct LaunchTarget {
  std::vector<std::string> words;
  std::vector<std::pair<std::string, std::string>> arguments;
};

// What a command that only looks at launch files lets Python take for one call (run_python_in_a_guest()). In a run,
// launch files have no limit of memory, and one of time only if the user gives it (python_watch.hpp).
struct PythonLimits {
  unsigned seconds = 60;
  bool seconds_given = false;
  std::uint64_t memory = 2ULL << 30U;  // bytes
};

// The options --python-seconds and --python-memory.
void add_python_limits(CLI::App& app, PythonLimits& limits);

// The variables that it fills must live until it has parsed.
class Subcommand {
 public:
  // `name` is "launch check".
  Subcommand(const std::string& name, const std::string& description);
  ~Subcommand();

  // Takes the words that are no options. At least one word that is no argument is required, unless it is `optional`.
  void take_target(LaunchTarget& target, bool optional = false);
  // Takes a value that is one of `values`: an option, or a word if `name` does not begin with "--".
  void take_choice(const std::string& name, std::string& value, const std::vector<std::string>& values,
                   const std::string& help);
  // Takes an option, or a word that may be left out if `name` does not begin with "--".
  void take_text(const std::string& name, std::string& value, const std::string& help);
  // Takes an option that may be given several times.
  void take_texts(const std::string& name, std::vector<std::string>& values, const std::string& help);
  // Takes the words that are no options.
  void take_words(const std::string& name, std::vector<std::string>& words, bool required, const std::string& help);
  void take_flag(const std::string& name, bool& value, const std::string& help);
  void take_python_limits(PythonLimits& limits);

  // Parses the words after the name of the command. Returns the exit code when there is nothing more to do: after
  // --help, and after an error, which it has printed.
  std::optional<int> parse(std::vector<std::string> words);

 private:
  std::unique_ptr<CLI::App> app_;
  LaunchTarget* target_ = nullptr;
  bool optional_target_ = false;
  std::vector<std::string> words_;
};

// To standard error. `command` is "launch check".
void print_errors(const LaunchError& error, const std::string& command);
// The same for an error in the command line.
void print_usage_error(const LaunchError& error, const std::string& command);

}  // namespace launch
