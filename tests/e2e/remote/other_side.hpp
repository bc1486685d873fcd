// SPDX-License-Identifier: Apache-2.0
// A launch on the other side of a connecting command, and commands with `--on` in a terminal here.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/plain_terminal.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/support/terminal.hpp"

namespace test_support {

inline constexpr std::chrono::seconds kPatience{60};

class OtherSide : public testing::Test {
 protected:
  OtherSide() {
    std::filesystem::create_directory(sandbox_.directory() / "run");
    environment_ = plain_terminal(sandbox_);
    environment_["XDG_RUNTIME_DIR"] = sandbox_.directory() / "run";
    // As ssh: words are joined, a shell reads them, and little of the environment arrives.
    write_script("connect", "exec env -i TERMINFO=\"$TERMINFO\" XDG_RUNTIME_DIR=\"$XDG_RUNTIME_DIR\" PATH=" +
                                std::filesystem::path(LAUNCH_PROGRAM).parent_path().string() +
                                ":/usr/bin:/bin sh -c \"$*\"");
  }

  void write_launch_file(const std::string& actions) const {
    write_file(sandbox_.directory() / "system.launch.xml", "<launch>\n" + actions + "\n</launch>\n");
  }
  void write_script(const std::string& name, const std::string& text) const {
    write_file(sandbox_.directory() / name, "#!/bin/sh\n" + text + "\n");
    std::filesystem::permissions(sandbox_.directory() / name, std::filesystem::perms::owner_all);
  }
  Command launch() const {
    return {.argv = {LAUNCH_PROGRAM, (sandbox_.directory() / "system.launch.xml").string()},
            .environment = environment_,
            .directory = sandbox_.directory()};
  }
  // The other side's command ends by itself, which may take longer than the end of the connection.
  void end(RunningCommand& run) {
    run.send_signal(SIGINT);
    EXPECT_EQ(run.wait().exit_code, 0);
    sandbox_.wait_until_daemons_are_left();
  }
  // `connect` is the name of a script.
  std::vector<std::string> ask_of(const std::string& command, const RunningCommand& run,
                                  const std::string& connect = "connect") const {
    return {LAUNCH_PROGRAM, command, "--launch", std::to_string(run.pid()), "--on", sandbox_.directory() / connect};
  }

  Sandbox sandbox_;
  std::map<std::string, std::string> environment_;
};

}  // namespace test_support
