// SPDX-License-Identifier: Apache-2.0
#include "programs/command_line/subcommand.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "base/terminal/terminal.hpp"
#include "programs/command_line/size_option.hpp"

namespace launch {

Subcommand::Subcommand(const std::string& name, const std::string& description)
    : app_(std::make_unique<CLI::App>(description, name)) {}

Subcommand::~Subcommand() = default;

void add_python_limits(CLI::App& app, PythonLimits& limits) {
  app.add_option(
         "--python-seconds", limits.seconds,
         "how long Python of a launch file, or a $(command …), may take at once; 60 by default where the file is "
         "only looked at, and for $(eval …)")
      ->type_name("N")
      ->check(CLI::Range(1U, 86400U))
      ->each([&limits](const std::string&) { limits.seconds_given = true; });
  app.add_option("--python-memory", limits.memory,
                 "how much memory Python may take where a launch file is only looked at, and for $(eval …): bytes, or "
                 "with K, M or G; 2G by default")
      ->type_name("SIZE")
      ->transform(size_in_bytes());
}

void Subcommand::take_target(LaunchTarget& target, bool optional) {
  target_ = &target;
  optional_target_ = optional;
  app_->add_option("words", words_, "launch files, or a package and a file of it; then arguments, name:=value")
      ->type_name("FILE ... | PACKAGE FILE  [NAME:=VALUE ...]");
}

void Subcommand::take_choice(const std::string& name, std::string& value, const std::vector<std::string>& values,
                             const std::string& help) {
  app_->add_option(name, value, help)->check(CLI::IsMember(values))->capture_default_str();
}

void Subcommand::take_text(const std::string& name, std::string& value, const std::string& help) {
  app_->add_option(name, value, help);
}

void Subcommand::take_texts(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  app_->add_option(name, values, help)->take_all()->expected(1)->allow_extra_args(false);
}

void Subcommand::take_words(const std::string& name, std::vector<std::string>& words, bool required,
                            const std::string& help) {
  app_->add_option(name, words, help)->required(required)->type_name("");
}

void Subcommand::take_flag(const std::string& name, bool& value, const std::string& help) {
  app_->add_flag(name, value, help);
}

void Subcommand::take_python_limits(PythonLimits& limits) {
  add_python_limits(*app_, limits);
}

std::optional<int> Subcommand::parse(std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // CLI11 wants them backwards
  try {
    app_->parse(words);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app_->help());
    return 0;
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "{}", usage_error_of(*app_, error));
    return kWrongCommandLine;
  }
  if (target_ == nullptr) {
    return std::nullopt;
  }
  for (const std::string& word : words_) {
    const std::size_t separator = word.find(":=");
    if (separator == std::string::npos) {
      target_->words.push_back(word);
    } else {
      target_->arguments.emplace_back(word.substr(0, separator), word.substr(separator + 2));
    }
  }
  if (target_->words.empty() && !optional_target_) {
    fmt::print(stderr, "{}", usage_error(app_->get_name(), "no launch file given"));
    return kWrongCommandLine;
  }
  return std::nullopt;
}

void print_errors(const LaunchError& error, const std::string& command) {
  fmt::print(stderr, "{}", render(error.diagnostics(), shows_colour(STDERR_FILENO), command));
}

void print_usage_error(const LaunchError& error, const std::string& command) {
  const Diagnostic& first = error.diagnostics().front();
  fmt::print(stderr, "{}", usage_error(command, first.message, first.help));
}

}  // namespace launch
