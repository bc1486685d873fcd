// SPDX-License-Identifier: Apache-2.0
// The file of the measured cost of events. Nobody else may decide which file is written.
#include "tracing/record/account/event_cost.hpp"

#include <gtest/gtest.h>
#include <pwd.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace {

namespace fs = std::filesystem;

using tracing::EventCost;

struct EventCostFile : testing::Test {
  EventCostFile() {
    unsetenv("XDG_CACHE_HOME");
    setenv("HOME", sandbox.directory().c_str(), 1);
  }

  static EventCost measured(double nanoseconds) {
    EventCost cost;
    cost.ns_per_event = nanoseconds;
    cost.cpu = tracing::processor_model();
    cost.lttng = LTTNG_VERSION_MEASURED;
    cost.context_fields = {"vpid"};
    cost.measured = "2026-11-21 20:15:00";
    return cost;
  }

  test_support::Sandbox sandbox;
};

TEST_F(EventCostFile, IsInTheCacheOfTheUser) {
  EXPECT_EQ(tracing::event_cost_file(), sandbox.directory() / ".cache/launch/event_cost.json");
  setenv("XDG_CACHE_HOME", "/elsewhere", 1);
  EXPECT_EQ(tracing::event_cost_file(), "/elsewhere/launch/event_cost.json");
  setenv("XDG_CACHE_HOME", "relative", 1);  // the specification says that this must be ignored
  EXPECT_EQ(tracing::event_cost_file(), sandbox.directory() / ".cache/launch/event_cost.json");
}

TEST_F(EventCostFile, IsInTheHomeOfThePasswordDatabaseWithoutHome) {
  const passwd* const user = getpwuid(getuid());
  const fs::path home = user == nullptr ? "/" : user->pw_dir;
  unsetenv("HOME");
  EXPECT_EQ(tracing::event_cost_file(), home / ".cache/launch/event_cost.json");
  setenv("HOME", "", 1);
  EXPECT_EQ(tracing::event_cost_file(), home / ".cache/launch/event_cost.json");
}

TEST_F(EventCostFile, HoldsWhatWasMeasuredLast) {
  EXPECT_FALSE(tracing::known_event_cost({"vpid"}).has_value());
  tracing::remember(measured(200));
  tracing::remember(measured(300));
  const std::optional<EventCost> known = tracing::known_event_cost({"vpid"});
  ASSERT_TRUE(known.has_value());
  EXPECT_EQ(known->ns_per_event, 300);
  EXPECT_FALSE(tracing::known_event_cost({"vtid"}).has_value());
}

TEST_F(EventCostFile, APlantedLinkIsReplacedAndItsTargetLeftAsItWas) {
  test_support::write_file(sandbox.directory() / "target", "precious\n");
  fs::create_directories(tracing::event_cost_file().parent_path());
  fs::create_symlink(sandbox.directory() / "target", tracing::event_cost_file());
  tracing::remember(measured(200));
  EXPECT_FALSE(fs::is_symlink(tracing::event_cost_file()));
  EXPECT_EQ(test_support::read_file(sandbox.directory() / "target"), "precious\n");
  EXPECT_TRUE(tracing::known_event_cost({"vpid"}).has_value());
}

TEST_F(EventCostFile, ALinkOfAnotherUserOnTheWayIsRefused) {
  fs::create_directory(sandbox.directory() / "elsewhere");
  fs::create_symlink("elsewhere", sandbox.directory() / ".cache");
  if (lchown((sandbox.directory() / ".cache").c_str(), 65534, 65534) != 0) {
    GTEST_SKIP() << "only root can make a link of another user";
  }
  EXPECT_THROW(tracing::remember(measured(200)), tracing::TraceError);
  EXPECT_TRUE(fs::is_empty(sandbox.directory() / "elsewhere"));
}

}  // namespace
