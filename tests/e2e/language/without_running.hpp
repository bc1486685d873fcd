// SPDX-License-Identifier: Apache-2.0
// The common part of the tests of commands that describe launch files without running them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace test_support {

class WithoutRunning : public testing::Test {
 protected:
  CommandResult launch(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), LAUNCH_PROGRAM);
    return run_command(Command{arguments, {}, sandbox_.directory()});
  }

  std::string file(const std::string& name, const std::string& text) {
    const auto path = sandbox_.directory() / name;
    write_file(path, text);
    return path.string();
  }

  // How the launcher, which runs in the folder of the file, names it.
  static std::string shown(const std::string& path) { return std::filesystem::path(path).filename().string(); }

  Sandbox sandbox_;
};

}  // namespace test_support
