// SPDX-License-Identifier: Apache-2.0
// With a real loop, and scripts in the place of launch-watch.
#include "launcher/conditions/condition_watch_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tests/support/trace_writer/temporary_directory.hpp"

namespace launch {
namespace {

using testing::ElementsAre;

struct ConditionWatchProcessTest : testing::Test {
  // What is told until the program records, or is not started again.
  std::vector<std::string> told_with(const std::string& script) {
    std::vector<std::string> told;
    const std::filesystem::path program = directory.path() / "watch";
    std::ofstream(program) << "#!/bin/sh\n" << script;
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    ConditionWatchProcess watch(*loop, "17", program.string());
    watch.observe([&](const tracing::ConditionReport& report) {
      bool goes_on = false;
      if (const auto* const failed = std::get_if<tracing::WatchFailed>(&report)) {
        told.push_back(failed->error + (failed->tries_again ? ", tries again" : ""));
        goes_on = failed->tries_again;
      } else if (std::holds_alternative<tracing::NodesAreRecorded>(report)) {
        told.emplace_back("recorded");
      }
      if (!goes_on) {
        watch.close();
        loop->quit();
      }
    });
    watch.watch(1, {.name = "/scan", .window = std::chrono::seconds(1)});
    loop->run();
    return told;
  }

  std::unique_ptr<EventLoop> loop = make_sd_event_loop();
  tracing::testing::TemporaryDirectory directory;
};

TEST_F(ConditionWatchProcessTest, AProgramThatCrashesBeforeItRecordsIsStartedAgain) {
  const std::string mark = (directory.path() / "started").string();
  EXPECT_THAT(told_with("[ -e " + mark + " ] || { touch " + mark +
                        "; kill -SEGV $$; }\necho '{\"recording\": true}'\nexec cat >/dev/null\n"),
              ElementsAre("launch-watch was ended by SIGSEGV, tries again", "recorded"));
}

TEST_F(ConditionWatchProcessTest, AProgramThatCrashesEachTimeIsGivenUp) {
  EXPECT_THAT(told_with("kill -SEGV $$\n"),
              ElementsAre("launch-watch was ended by SIGSEGV, tries again",
                          "launch-watch was ended by SIGSEGV, tries again", "launch-watch was ended by SIGSEGV"));
}

TEST_F(ConditionWatchProcessTest, AProgramThatSaysWhyItEndsIsNotStartedAgain) {
  EXPECT_THAT(told_with("echo '{\"error\": \"there is no relay daemon\", \"help\": \"\"}'\n"),
              ElementsAre("there is no relay daemon"));
}

}  // namespace
}  // namespace launch
