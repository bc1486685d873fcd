// SPDX-License-Identifier: Apache-2.0
// What counts as a failure of a launch, and what it says at its end.
#include <signal.h>

#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

class FailuresTest : public LaunchServiceTest {};

TEST_F(FailuresTest, AreProcessesThatEndBadlyUnasked) {
  runner_.script("bad", {{.exits_after = 1s, .exit_code = 42}});
  runner_.script("crash", {{.exits_after = 2s, .exit_code = -SIGSEGV}});
  runner_.script("good", {{.exits_after = 3s}});
  runner_.script("missing", {{.spawn_error = ENOENT}});
  EXPECT_EQ(run("<executable cmd=\"bad\"/>\n<executable cmd=\"crash\"/>\n<executable cmd=\"good\"/>\n"
                "<executable cmd=\"missing\"/>"),
            3);
  EXPECT_THAT(messages_,
              ElementsAre("[launch] 3 processes have failed:",
                          "[launch]   bad-1: exit code 42 after 1.00 s, with 0.00 s of processor time and 0.0 MiB "
                          "(/test/system.launch.xml:2:2)",
                          "[launch]   crash-2: SIGSEGV after 2.00 s, with 0.00 s of processor time and 0.0 MiB "
                          "(/test/system.launch.xml:3:2)",
                          "[launch]   missing-4: not started, cannot start 'missing': No such file or directory "
                          "(/test/system.launch.xml:5:2)"));
}

TEST_F(FailuresTest, CountAlsoWhenTheProcessIsStartedAgain) {
  runner_.script("a", {{.exits_after = 1s, .exit_code = 1}, {.exits_after = 2s, .exit_code = 2}, {.exits_after = 1s}});
  EXPECT_EQ(run(R"xml(<executable cmd="a" respawn="true" respawn_max_retries="2"/>)xml"), 3);
  EXPECT_THAT(messages_, ElementsAre("[launch] 1 process has failed:",
                                     "[launch]   a-1: exit code 2 after 2.00 s, with 0.00 s of processor time and 0.0 "
                                     "MiB; the last of 2 failures (/test/system.launch.xml:2:2)"));
}

TEST_F(FailuresTest, AreNoProcessesThatWereAskedToEnd) {
  runner_.default_script({.exit_code_on_signal = 7});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><timer period="1.0"><shutdown/></timer>)xml"), 0);
  EXPECT_THAT(messages_, IsEmpty());
}

TEST_F(FailuresTest, AreCrashesOnTheWayToTheEnd) {
  runner_.script("a", {{.exit_code_on_signal = -SIGSEGV}});
  runner_.script("b", {{.exit_code_on_signal = -SIGABRT}});
  runner_.script("c", {{.exit_code_on_signal = -SIGTERM}});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><executable cmd="b" allowed-exit-codes="SIGABRT"/><executable cmd="c"/>
<timer period="1.0"><shutdown/></timer>)xml"),
            3);
  EXPECT_THAT(messages_, ElementsAre("[launch] 1 process has failed:",
                                     "[launch]   a-1: SIGSEGV after 1.00 s, with 0.00 s of processor time and 0.0 MiB "
                                     "(/test/system.launch.xml:2:2)"));
}

TEST_F(FailuresTest, AreNoEndsThatTheFileAllows) {
  runner_.script("a", {{.exits_after = 1s, .exit_code = 2}});
  runner_.script("b", {{.exits_after = 1s, .exit_code = -SIGTERM}});
  runner_.script("c", {{.exits_after = 1s, .exit_code = 99}});
  runner_.script("d", {{.exits_after = 1s}});
  EXPECT_EQ(run(R"xml(<let name="codes" value="2, SIGTERM"/><executable cmd="a" allowed-exit-codes="$(var codes)"/>
<executable cmd="b" allowed-exit-codes="$(var codes)"/><executable cmd="c" allowed-exit-codes="any"/>
<executable cmd="d" allowed-exit-codes="1"/>)xml"),
            0);
  EXPECT_THAT(messages_, IsEmpty());
}

TEST_F(FailuresTest, OfARequiredProcessThatTheFileAllowsEndTheLaunchWithZero) {
  runner_.script("a", {{.exits_after = 1s, .exit_code = 2}});
  EXPECT_EQ(run(R"xml(<executable cmd="a" required="true" allowed-exit-codes="2"/><executable cmd="b"/>)xml"), 0);
}

TEST_F(FailuresTest, AreToldButDontCountIfTheyAreIgnored) {
  on_service = [](LaunchService& service) { service.ignore_failures(); };
  runner_.default_script({.exits_after = 1s, .exit_code = 42});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>)xml"), 0);
  EXPECT_EQ(messages_.at(0), "[launch] 1 process has failed:");
}

TEST_F(FailuresTest, AreLessThanAnErrorOfTheLaunch) {
  runner_.default_script({.exits_after = 1s, .exit_code = 42});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><timer period="2.0"><log message="$(var missing)"/></timer>)xml"), 1);
}

TEST_F(FailuresTest, ASecondSignalCutsTheEndShortWhichTheExitCodeTells) {
  runner_.default_script({.ignores = {SIGINT}});
  const auto first = loop_.after(1s, [this] { loop_.deliver_signal(SIGINT); });
  const auto second = loop_.after(3s, [this] { loop_.deliver_signal(SIGTERM); });
  EXPECT_EQ(run(R"xml(<executable cmd="a" sigterm_timeout="100"/>)xml"), 128 + SIGTERM);
}

TEST_F(FailuresTest, TheFirstSignalIsAnOrdinaryEnd) {
  const auto first = loop_.after(1s, [this] { loop_.deliver_signal(SIGINT); });
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>)xml"), 0);
}

}  // namespace
}  // namespace launch
