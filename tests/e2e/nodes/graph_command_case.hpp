// SPDX-License-Identifier: Apache-2.0
// Runs commands on the graph beside programs of the stack.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "tests/support/command.hpp"

namespace test_support {

inline constexpr std::chrono::seconds kPatience{60};

inline Command launch_words(std::vector<std::string> words) {
  words.insert(words.begin(), LAUNCH_PROGRAM);
  return Command{words};
}

inline CommandResult launch_command(const std::vector<std::string>& words) {
  return run_command(launch_words(words), kPatience);
}

// "demo_nodes/talker"
inline Command program_of_stack(const std::string& path, std::vector<std::string> arguments = {}) {
  arguments.insert(arguments.begin(), BUILD_DIRECTORY "/prefix/lib/" + path);
  return Command{arguments};
}

// Asks again until the answer has the text, because nodes are found a moment after they have started.
inline CommandResult ask_until(const std::vector<std::string>& words, const std::string& text) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (true) {
    const CommandResult result = launch_command(words);
    if ((result.out + result.err).find(text) != std::string::npos || std::chrono::steady_clock::now() >= end) {
      return result;
    }
  }
}

}  // namespace test_support
