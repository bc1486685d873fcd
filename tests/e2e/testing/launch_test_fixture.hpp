// SPDX-License-Identifier: Apache-2.0
// The common part of the tests of `launch test`: a place for launch files, and what the command prints.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace test_support {

class LaunchTestFixture : public testing::Test {
 protected:
  // A launch file with these actions. Returns its path.
  std::string write(const std::string& name, const std::string& actions) {
    const std::filesystem::path path = sandbox_.directory() / name;
    std::filesystem::create_directories(path.parent_path());
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }

  static CommandResult run(std::vector<std::string> words) {
    words.insert(words.begin(), {LAUNCH_PROGRAM, "test"});
    return run_command({.argv = std::move(words)}, std::chrono::seconds(100));
  }

  // Waits until a process of a test has made the file.
  bool appears(const std::string& name) const {
    const std::filesystem::path path = sandbox_.directory() / name;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!std::filesystem::exists(path) && std::chrono::steady_clock::now() < end) {
      ::usleep(10'000);
    }
    return std::filesystem::exists(path);
  }

  // Without times and directories, which differ.
  std::string plain(const std::string& text) const {
    std::string result = std::regex_replace(text, std::regex("(  |, in | at )[0-9.]+ s"), "$1T s");
    result = std::regex_replace(result, std::regex("files: .*/"), "files: DIR/");
    for (std::size_t at = 0; (at = result.find(sandbox_.directory().string() + "/", at)) != std::string::npos;) {
      result.erase(at, sandbox_.directory().string().size() + 1);
    }
    return result;
  }

  Sandbox sandbox_;
};

}  // namespace test_support
