// SPDX-License-Identifier: Apache-2.0
// launch-ros-command COMMAND VERB …: what `launch topic`, `launch interface` and others become. It is the part of these
// commands that links a middleware.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <string>
#include <vector>

#include "base/diagnostics/command_error.hpp"
#include "base/diagnostics/diagnostic.hpp"
#include "base/terminal/terminal.hpp"
#include "base/text/names.hpp"
#include "programs/ros/verb.hpp"

namespace launch {
namespace {

constexpr int kFailed = 1;

std::vector<const VerbInfo*> verbs_of(const std::string& command) {
  std::vector<const VerbInfo*> verbs;
  for (const VerbInfo& verb : all_verbs()) {
    if (verb.command == command) {
      verbs.push_back(&verb);
    }
  }
  return verbs;
}

// "prints the messages of a topic" -> "Prints the messages of a topic."
std::string sentence(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text + ".";
}

std::string help_of(const CommandOfVerbs& command) {
  CLI::App app(sentence(command.help), "launch " + command.name);
  app.require_subcommand(1);
  for (const VerbInfo* const verb : verbs_of(command.name)) {
    app.add_subcommand(verb->name, verb->help);
  }
  return app.help();
}

// Options if the last word begins like one, else what the verb itself offers at this place.
std::vector<std::string> completions_of(const VerbInfo& info, const std::vector<std::string>& words) {
  const std::unique_ptr<Verb> verb = info.make();
  CLI::App app;
  verb->declare(app);
  std::vector<std::string> candidates;
  if (words.back().starts_with('-')) {
    for (const CLI::Option* const option : app.get_options()) {
      for (const std::string& name : option->get_lnames()) {
        candidates.push_back("--" + name);
      }
    }
    return candidates;
  }
  std::vector<std::string> places;  // the words before that are no options
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (!words[i].starts_with('-')) {
      places.push_back(words[i]);
    }
  }
  try {
    return verb->complete(places);
  } catch (const std::exception&) {
    return {};
  }
}

int run_verb(const VerbInfo& info, std::vector<std::string> words) {
  const std::string name = fmt::format("launch {}{}{}", info.command, info.name.empty() ? "" : " ", info.name);
  const std::unique_ptr<Verb> verb = info.make();
  CLI::App app(sentence(info.help), name);
  verb->declare(app);
  std::reverse(words.begin(), words.end());  // CLI11 wants them backwards
  try {
    app.parse(words);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return 0;
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "{}", usage_error_of(app, error));
    return kWrongCommandLine;
  }
  try {
    return verb->run();
  } catch (const LaunchError& error) {
    fmt::print(stderr, "{}", render(error.diagnostics(), shows_colour(STDERR_FILENO), name));
  } catch (const CommandError& error) {
    fmt::print(stderr, "{}", command_error(name, error.what(), error.help()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}", command_error(name, error.what()));
  }
  return kFailed;
}

// The candidates for the last word of `words`, which begin with "topic".
int complete(const std::vector<std::string>& words) {
  std::vector<std::string> candidates;
  if (words.size() == 2) {
    candidates.emplace_back("--help");
  }
  for (const VerbInfo* const verb : verbs_of(words.front())) {
    if (verb->name.empty()) {
      candidates = completions_of(*verb, {words.begin() + 1, words.end()});
    } else if (words.size() == 2) {
      candidates.push_back(verb->name);
    } else if (words.size() > 2 && verb->name == words[1]) {
      candidates = completions_of(*verb, {words.begin() + 2, words.end()});
    }
  }
  std::erase_if(candidates, [&](const std::string& candidate) { return !candidate.starts_with(words.back()); });
  std::sort(candidates.begin(), candidates.end());
  for (const std::string& candidate : candidates) {
    fmt::print("{}\n", candidate);
  }
  return 0;
}

int run(const CommandOfVerbs& command, std::vector<std::string> words) {
  if (const std::vector<const VerbInfo*> verbs = verbs_of(command.name); verbs.front()->name.empty()) {
    return run_verb(*verbs.front(), std::move(words));
  }
  if (words.empty() || words.front() == "--help" || words.front() == "-h") {
    fmt::print(words.empty() ? stderr : stdout, "{}", help_of(command));
    return words.empty() ? kWrongCommandLine : 0;
  }
  KnownWords known{.options = {"-h", "--help"}, .commands = {}};
  for (const VerbInfo* const verb : verbs_of(command.name)) {
    if (verb->name == words.front()) {
      return run_verb(*verb, {words.begin() + 1, words.end()});
    }
    known.commands.push_back(verb->name);
  }
  fmt::print(stderr, "{}", unexpected_word_error("launch " + command.name, words, known, "unexpected words"));
  return kWrongCommandLine;
}

int run_program(const std::vector<std::string>& words) {
  if (words.size() > 2 && words.front() == "complete") {
    return complete({words.begin() + 1, words.end()});
  }
  for (const CommandOfVerbs& command : all_commands()) {
    if (!words.empty() && command.name == words.front()) {
      return run(command, {words.begin() + 1, words.end()});
    }
  }
  fmt::print(stderr, "launch-ros-command is started by launch, not by hand\n");
  return kWrongCommandLine;
}

}  // namespace
}  // namespace launch

int main(int argc, char** argv) {
  return launch::run_program({argv + 1, argv + argc});
}
