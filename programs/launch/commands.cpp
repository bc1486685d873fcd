// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/commands.hpp"

#include <errno.h>
#include <fmt/format.h>
#include <string.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "base/diagnostics/command_error.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/control/control_client.hpp"
#include "launcher/ros/ros_program.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/completion/help_options.hpp"
#include "programs/launch/remote/on_option.hpp"

namespace launch {

namespace {

Words words_of_name(const Command& command) {
  Words words;
  for (std::string_view rest = command.name; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    words.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return words;
}

bool is_listed(const Command& command) {
  return *command.help != 0;
}

std::string name_with_launch(const Command& command) {
  return *command.name == 0 ? "launch" : fmt::format("launch {}", command.name);
}

int become(const Command& command, const Words& words) {
  std::string program = own_library_file(command.program);
  if (command.asks_nodes) {
    try {
      program = ros_program(command.program, own_environment());
    } catch (const LaunchError& error) {
      print_errors(error, name_with_launch(command));
      return 1;
    }
  }
  Words named(words.begin() + (command.program_gets_name ? 0 : std::ptrdiff_t(words_of_name(command).size())),
              words.end());
  named.insert(named.begin(), command.program_gets_name ? "launch" : name_with_launch(command));
  std::vector<char*> argv;
  for (std::string& word : named) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
  const std::string why = errno == ENOENT ? needs_missing_file(command.program)
                                          : fmt::format("can't run {}: {}", program, ::strerror(errno));
  fmt::print(stderr, "{}", command_error(name_with_launch(command), why));
  return 1;
}

// The names of options if the last word begins like one, or the values of the option before it if its help lists them.
// Nothing if something else stands here.
Words option_words(const Command& command, const Words& words) {
  const bool is_name = words.back().starts_with('-');
  if (!is_name && (words.size() < 2 || !words[words.size() - 2].starts_with("--"))) {
    return {};
  }
  const std::vector<HelpOption> options = options_of_command(words_of_name(command));
  Words names = *command.name == 0 ? Words{"--dry-run=json", "--dry-run=shell"} : Words{};
  for (const HelpOption& option : options) {
    if (!is_name &&
        std::find(option.names.begin(), option.names.end(), words[words.size() - 2]) != option.names.end()) {
      return option.choices;
    }
    std::copy_if(option.names.begin(), option.names.end(), std::back_inserter(names),
                 [](const std::string& name) { return name.starts_with("--"); });
  }
  return is_name ? names : Words{};
}

Words candidates(const Words& words) {
  const Words before(words.begin(), words.end() - 1);
  const Words none;
  const Command& found = find_command(before);
  const Command& command = found.hidden ? find_command(none) : found;
  if (!command.completes_options) {
    const Words of_options = option_words(command, words);
    if (!of_options.empty() || words.back().starts_with('-')) {
      return of_options;
    }
  }
  // What is on another machine is not known here.
  const bool is_here = !command.asks_launch || take_on_option(before, own_environment()).connect.empty();
  Words all = command.complete == nullptr || !is_here ? Words{} : command.complete(words);
  if (words.size() == 1) {
    const Words names = listed_command_names();
    all.insert(all.end(), names.begin(), names.end());
  }
  return all;
}

}  // namespace

const Command& find_command(const Words& words) {
  const Command* longest = nullptr;
  std::size_t most = 0;
  for (const Command& command : command_table()) {
    const Words name = words_of_name(command);
    if (name.size() <= words.size() && std::equal(name.begin(), name.end(), words.begin()) &&
        (longest == nullptr || name.size() > most)) {
      longest = &command;
      most = name.size();
    }
  }
  return *longest;
}

int run_command_of(const Words& all_words) {
  const Command& command = find_command(all_words);
  Words words = all_words;
  if (command.asks_launch) {
    const std::ptrdiff_t name_length = std::ptrdiff_t(words_of_name(command).size());
    const OnOption on = take_on_option({words.begin() + name_length, words.end()}, own_environment());
    if (on.lacks_value) {
      fmt::print(stderr, "{}", usage_error(name_with_launch(command), "--on needs a value"));
      return kWrongCommandLine;
    }
    words.resize(words_of_name(command).size());
    words.insert(words.end(), on.words.begin(), on.words.end());
    if (!on.connect.empty()) {
      return run_on_other_side(name_with_launch(command), on.connect, words, command.other_terminal);
    }
  }
  if (command.program != nullptr) {
    return become(command, words);
  }
  const std::string name = name_with_launch(command);
  try {
    return command.run({words.begin() + std::ptrdiff_t(words_of_name(command).size()), words.end()});
  } catch (const LaunchError& error) {
    print_errors(error, name);
  } catch (const ControlError& error) {
    fmt::print(stderr, "{}", command_error(name, error.what(), error.help()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}", command_error(name, error.what()));
  }
  return 1;
}

Words listed_command_names() {
  Words names;
  for (const Command& command : command_table()) {
    if (is_listed(command)) {
      names.emplace_back(command.name);
    }
  }
  return names;
}

std::string list_of_commands() {
  std::string text = "Other commands (launch COMMAND --help):\n";
  for (const Command& command : command_table()) {
    if (is_listed(command)) {
      text += fmt::format("  launch {:<16} {}\n", fmt::format("{} {}", command.name, command.operand), command.help);
    }
  }
  return text;
}

Words completions(const Words& words) {
  if (words.empty()) {
    return {};
  }
  Words found;
  try {
    found = candidates(words);
  } catch (const std::runtime_error&) {
    return {};  // the file has errors, or there is no such package: nothing to offer
  }
  std::erase_if(found, [&](const std::string& candidate) { return !candidate.starts_with(words.back()); });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace launch
