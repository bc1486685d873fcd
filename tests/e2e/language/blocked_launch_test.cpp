// SPDX-License-Identifier: Apache-2.0
// Launches whose loop is blocked by what a launch file holds: they end all the same.
#include <gmock/gmock.h>
#include <signal.h>

#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

constexpr std::chrono::seconds kPatience{60};

class BlockedLaunch : public testing::Test {
 protected:
  std::string python_file(const std::string& body) const {
    const auto path = sandbox_.directory() / "system.launch.py";
    write_file(
        path,
        "import time\nfrom launch import LaunchDescription\nfrom launch.actions import "
        "ExecuteProcess, OpaqueFunction, TimerAction\n\n\ndef block(context):\n" +
            body +
            "\n\n\ndef generate_launch_description():\n"
            "    return LaunchDescription([ExecuteProcess(cmd=['sleep', '1000']),\n"
            "                              TimerAction(period=0.0, actions=[OpaqueFunction(function=block)])])\n");
    return path.string();
  }

  Sandbox sandbox_;
};

TEST_F(BlockedLaunch, PythonThatSleepsIsInterrupted) {
  const std::string file = python_file("    print('blocked', flush=True)\n    time.sleep(1000)");
  for (const int number : {SIGINT, SIGTERM}) {
    RunningCommand launch({.argv = {LAUNCH_PROGRAM, file}});
    ASSERT_TRUE(launch.wait_for_output("blocked", kPatience)) << launch.out() << launch.err();
    launch.send_signal(number);
    const CommandResult result = launch.wait(kPatience);
    EXPECT_FALSE(result.timed_out) << result.out;
    EXPECT_EQ(result.exit_code, 1) << result.out << result.err;
    EXPECT_THAT(result.out + result.err, HasSubstr("system.launch.py:8:5: error: interrupted by a signal\n"
                                                   "    8 |     time.sleep(1000)\n"));
    EXPECT_TRUE(result.output_closed) << "no process is left";
  }
}

TEST_F(BlockedLaunch, ACommandThatDoesNotEndIsEnded) {
  const auto path = sandbox_.directory() / "system.launch.xml";
  // The second one has closed its output, so only its end can be waited for.
  for (const char* const script : {"sleep 1000", "exec sleep 1000 &gt;&amp;- 2&gt;&amp;-"}) {
    const auto sign = sandbox_.directory() / "sign";
    run_command({"mkfifo", sign});
    write_file(path,
               "<launch>\n<executable cmd=\"sleep 1000\"/>\n<timer period=\"0\">\n<let name=\"x\" value=\"$(command "
               "'sh -c \\'echo > " +
                   sign.string() + "; " + script + "\\'' ignore)\"/>\n</timer>\n</launch>\n");
    RunningCommand launch({.argv = {LAUNCH_PROGRAM, path}});
    run_command({"cat", sign});
    launch.send_signal(SIGINT);
    const CommandResult result = launch.wait(kPatience);
    EXPECT_FALSE(result.timed_out) << result.out;
    EXPECT_EQ(result.exit_code, 1) << result.out << result.err;
    EXPECT_THAT(result.out + result.err, HasSubstr(" failed: interrupted by a signal\n"));
    EXPECT_TRUE(result.output_closed) << "no process is left";
    std::filesystem::remove(sign);
  }
}

// Code that goes on whatever comes.
constexpr const char* kDeaf =
    "    while True:\n"
    "        try:\n"
    "            print('blocked', flush=True)\n"
    "            time.sleep(1000)\n"
    "        except KeyboardInterrupt:\n"
    "            pass";

TEST_F(BlockedLaunch, TheGuardianEndsALauncherThatTakesNoSignal) {
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, python_file(kDeaf)}});
  ASSERT_TRUE(launch.wait_for_output("blocked", kPatience)) << launch.out() << launch.err();
  launch.send_signal(SIGINT);
  const CommandResult result = launch.wait(kPatience);
  EXPECT_EQ(result.signal, SIGKILL) << result.out << result.err;
  EXPECT_THAT(result.out,
              HasSubstr("[ERROR] [launch]: the launcher has not answered a signal for 10 s, so something in "
                        "it is blocked; launch-guardian ends it\n"));
  EXPECT_TRUE(result.output_closed) << "no process is left";
}

TEST_F(BlockedLaunch, TheSpareEndsABlockedLauncherWhoseGuardianWasKilled) {
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, python_file(kDeaf)}});
  ASSERT_TRUE(launch.wait_for_output("blocked", kPatience)) << launch.out() << launch.err();
  launch.send_signal(SIGKILL);
  EXPECT_EQ(launch.wait(kPatience).signal, SIGKILL);
  Sandbox::wait_until_daemons_are_left();
}

}  // namespace
