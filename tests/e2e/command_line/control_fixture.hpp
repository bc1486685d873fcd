// SPDX-License-Identifier: Apache-2.0
// Launches with a directory for sockets of their own, and the commands that talk with them.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace test_support {

inline constexpr std::chrono::seconds kPatience{60};

// Waits for a line of its input, so that nothing of a test depends on time.
inline const std::string kTalker = R"xml(<executable name="talker" shell="true" output="both"
    cmd="got() { echo got USR1; }; trap got USR1; echo ready; while :; do read x; done"/>)xml";
inline const std::string kSleeper = R"xml(<executable name="sleeper" cmd="sleep 1000" respawn="true"/>)xml";

class Control : public testing::Test {
 protected:
  Control() : runtime_(sandbox_.directory() / "run") {
    std::filesystem::create_directory(runtime_);
    environment_ = {{"XDG_RUNTIME_DIR", runtime_.string()}};
  }

  std::string write(const std::string& actions, const std::string& name = "system.launch.xml") {
    const std::filesystem::path path = sandbox_.directory() / name;
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }

  Command launch(std::vector<std::string> words) const {
    words.insert(words.begin(), LAUNCH_PROGRAM);
    return {.argv = std::move(words), .environment = environment_, .directory = sandbox_.directory()};
  }
  CommandResult ask(const std::vector<std::string>& words) const { return run_command(launch(words), kPatience); }
  nlohmann::json ps() const { return nlohmann::json::parse(ask({"ps", "--json"}).out); }

  // The names of what is in the directory for sockets.
  std::vector<std::string> sockets() const {
    std::vector<std::string> names;
    for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(runtime_ / "launch")) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

  // The child of the spare guardian, which is the child of the guardian.
  static pid_t launcher_below(pid_t guardian) {
    pid_t process = guardian;
    for (int level = 0; level < 2; ++level) {
      const std::string number = std::to_string(process);
      process = std::stoi(read_file("/proc/" + number + "/task/" + number + "/children"));
    }
    return process;
  }

  Sandbox sandbox_;
  std::filesystem::path runtime_;
  std::map<std::string, std::string> environment_;
};

}  // namespace test_support
