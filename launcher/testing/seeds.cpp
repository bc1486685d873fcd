// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/seeds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cstdint>

#include "base/text/quoted_text.hpp"

namespace launch {

namespace {

std::uint64_t seed_of(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw UsageError(fmt::format("--seed takes a whole number, got '{}'", text));
  }
  return seed;
}

std::set<std::size_t> numbers_of(const std::string& text) {
  std::set<std::size_t> numbers;
  if (text == "none") {
    return numbers;
  }
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.insert(whole_number(text.substr(begin, end - begin), "--faults"));
    begin = end + 1;
  }
  return numbers;
}

void choose_faults(const std::string& text, std::vector<TestCase>& tests) {
  const std::set<std::size_t> numbers = numbers_of(text);
  for (TestCase& test : tests) {
    if (!numbers.empty() && *numbers.rbegin() > test.fault_count) {
      throw UsageError(fmt::format("--faults {}: the test '{}' has {} fault{}", text, test.name, test.fault_count,
                                   test.fault_count == 1 ? "" : "s"));
    }
    test.faults = numbers;
  }
}

// As a pattern that only this name matches.
std::string as_pattern(const std::string& name) {
  std::string pattern;
  for (const char c : name) {
    pattern += std::string_view("*?[\\").find(c) == std::string_view::npos ? "" : "\\";
    pattern += c;
  }
  return pattern;
}

}  // namespace

std::size_t whole_number(const std::string& text, const char* option) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number == 0) {
    throw UsageError(fmt::format("{} takes a number from 1, got '{}'", option, text));
  }
  return number;
}

void apply_seeds(const SeedOptions& options, std::vector<TestCase>& tests) {
  if (!options.seed.empty() && !options.seeds.empty()) {
    throw UsageError("--seed and --seeds exclude each other");
  }
  if (!options.faults.empty()) {
    choose_faults(options.faults, tests);
  }
  if (!options.seed.empty()) {
    for (TestCase& test : tests) {
      test.seed = seed_of(options.seed);
      test.shows_seed = true;
    }
  }
  if (!options.seeds.empty()) {
    const std::size_t seeds = whole_number(options.seeds, "--seeds");
    std::vector<TestCase> all;
    for (const TestCase& test : tests) {
      for (std::size_t seed = 1; seed <= seeds; ++seed) {
        TestCase& copy = all.emplace_back(test);
        copy.seed = seed;
        copy.shows_seed = copy.seed_in_name = true;
      }
    }
    tests = std::move(all);
  }
}

std::string command_of(const TestCase& test, const LaunchArguments& arguments) {
  std::string command = fmt::format("launch test {}", shell_quoted(test.file));
  if (!test.is_only) {
    command += fmt::format(" --name {}", shell_quoted(as_pattern(test.name)));
  }
  command += fmt::format(" --seed {}", test.seed);
  if (test.faults) {
    command +=
        fmt::format(" --faults {}", test.faults->empty() ? "none" : fmt::format("{}", fmt::join(*test.faults, ",")));
  }
  for (const auto& [name, value] : arguments) {
    command += " " + shell_quoted(name + ":=" + value);
  }
  return command;
}

}  // namespace launch
