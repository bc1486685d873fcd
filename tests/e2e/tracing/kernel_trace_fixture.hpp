// SPDX-License-Identifier: Apache-2.0
// The common part of the tests of kernel events: a launch with <trace>, and the lines of its trace.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace test_support {

namespace fs = std::filesystem;

// Lists the instances. For this, tracefs must be mounted.
inline constexpr const char* kSeeTracefs =
    "ls /sys/kernel/tracing/instances 2>/dev/null || "
    "{ mount -t tracefs none /sys/kernel/tracing && ls /sys/kernel/tracing/instances; }";

class KernelTrace : public testing::Test {
 protected:
  void SetUp() override {
    if (geteuid() != 0) {
      GTEST_SKIP() << "skipped, because the kernel is traced by root alone";
    }
    if (run_command({"unshare", "-m", "sh", "-c", kSeeTracefs}).exit_code != 0) {
      GTEST_SKIP() << "skipped, because tracefs can't be mounted here";
    }
  }

  CommandResult launch(const std::string& actions) const {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return run_command({LAUNCH_PROGRAM, path});
  }

  static std::vector<std::string> lines_of(const fs::path& directory) {
    const CommandResult read = run_command({"babeltrace2", directory.string()});
    EXPECT_EQ(read.exit_code, 0) << read.err;
    std::vector<std::string> lines;
    std::istringstream out(read.out);
    for (std::string line; std::getline(out, line);) {
      lines.push_back(line);
    }
    return lines;
  }

  // The consumer daemons in the mount namespace of this test.
  static std::vector<long> own_consumers() {
    std::vector<long> consumers;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      std::error_code error;
      std::string name;
      std::getline(std::ifstream(entry.path() / "comm") >> std::ws, name);
      if (name == "lttng-consumerd" &&
          fs::read_symlink(entry.path() / "ns/mnt", error) == fs::read_symlink("/proc/self/ns/mnt")) {
        consumers.push_back(std::stol(entry.path().filename()));
      }
    }
    return consumers;
  }

  // The number after `key` in the first line from `begin` on that has all the texts; -1 if no line has them. `found`
  // gets the index of the line.
  static long number_in(const std::vector<std::string>& lines, const std::vector<std::string>& texts,
                        const std::string& key, std::size_t& found, std::size_t begin = 0) {
    for (std::size_t i = begin; i < lines.size(); ++i) {
      if (!std::all_of(texts.begin(), texts.end(),
                       [&](const std::string& text) { return lines[i].find(text) != std::string::npos; })) {
        continue;
      }
      found = i;
      const std::size_t value = lines[i].find(key + " = ");
      return value == std::string::npos ? -1 : std::stol(lines[i].substr(value + key.size() + 3));
    }
    return -1;
  }

  // The snapshots of the session, from the oldest to the newest.
  std::vector<fs::path> snapshots_of(const std::string& session) const {
    std::vector<fs::path> snapshots;
    for (const auto& entry : fs::directory_iterator(sandbox_.trace_directory() / session)) {
      if (entry.path().filename().string().starts_with("snapshot-")) {
        snapshots.push_back(entry.path());
      }
    }
    std::sort(snapshots.begin(), snapshots.end());
    return snapshots;
  }

  // All sandboxes share the instances of the kernel.
  const std::string session_ = "kernel_test_" + std::to_string(getpid());
  Sandbox sandbox_;
};

}  // namespace test_support
