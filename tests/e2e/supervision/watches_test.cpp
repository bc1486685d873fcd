// SPDX-License-Identifier: Apache-2.0
// Watches that look from outside, or that the process answers itself: topics, services, life cycles, ports and
// sd_notify(3).
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr std::chrono::seconds kPatience(60);

class Watches : public testing::Test {
 protected:
  CommandResult launch(const std::string& actions) {
    return run_command({.argv = {LAUNCH_PROGRAM, write(actions)}}, kPatience);
  }
  std::string write(const std::string& actions) {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }
  static std::string node(const std::string& how, const std::string& watch) {
    return R"xml(<executable name="node" output="screen" sigterm_timeout="0.2" sigkill_timeout="0.2" cmd=")xml" HANGING_NODE
           " " +
           how + "\">" + watch + "</executable>";
  }
  // A process that runs this Python script.
  std::string script(const std::string& text, const std::string& watch, const std::string& name = "script") {
    const fs::path path = sandbox_.directory() / (name + ".py");
    write_file(path, text);
    return "<executable name=\"" + name + "\" output=\"screen\" cmd=\"/usr/bin/python3 -u " + path.string() + "\">" +
           watch + "</executable>";
  }
  // The launch ends as soon as the process is healthy, and is done then.
  static std::string end_when_healthy(const std::string& name) {
    return R"xml(<executable cmd="echo it is healthy" output="screen" on_exit="shutdown">
                   <depends_on process=")xml" +
           name + R"xml(" condition="healthy" timeout="30"/></executable>)xml";
  }

  Sandbox sandbox_;
};

TEST_F(Watches, FindsATopicThatFallsSilentWhileItsNodeSpins) {
  const CommandResult result = launch(node(
      "silent", R"xml(<watch kind="topic" topic="/beats" timeout="2" interval="0.2" on_unhealthy="shutdown"/>)xml"));
  EXPECT_THAT(result.err + result.out,
              ContainsRegex("\\[node-1\\]: process is unhealthy: no message has come on '/beats' for [0-9.]+ s \\("));
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
}

TEST_F(Watches, FindsATopicThatIsTooSlow) {
  const CommandResult result =
      launch(node("slow", R"xml(<watch kind="topic" topic="/beats" min_rate="10" timeout="2" interval="0.2"
                                       start_period="20" on_unhealthy="shutdown"/>)xml"));
  EXPECT_THAT(result.err + result.out,
              ContainsRegex("process is unhealthy: '/beats' has had [0-9.]+ messages a second in the last [0-9.]+ s, "
                            "not 10.0 \\("));
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
}

TEST_F(Watches, ATopicWithItsRateIsHealthy) {
  const CommandResult result =
      launch(node("ever", R"xml(<watch kind="topic" topic="/beats" min_rate="5" timeout="2"/>)xml") +
             end_when_healthy("node"));
  EXPECT_THAT(result.out, HasSubstr("it is healthy\n"));
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(Watches, FindsANodeThatAnswersNoMore) {
  const CommandResult result =
      launch(node("sleep", R"xml(<watch kind="service" service="/hanging_node/get_parameters" timeout="2" interval="0.4"
                                 on_unhealthy="shutdown"/>)xml"));
  EXPECT_THAT(
      result.err + result.out,
      ContainsRegex("process is unhealthy: the service '/hanging_node/get_parameters' has not answered for [0-9.]+ s"));
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
}

TEST_F(Watches, FindsAServiceThatIsNotThere) {
  const CommandResult result = launch(
      R"xml(<executable name="one" cmd="sleep 1000">
              <watch kind="service" service="/map/load" timeout="1" on_unhealthy="shutdown"/></executable>)xml");
  EXPECT_THAT(result.err + result.out,
              ContainsRegex("process is unhealthy: there has been no service '/map/load' for [0-9.]+ s"));
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
}

TEST_F(Watches, FindsANodeThatIsNotActive) {
  const CommandResult result = launch(
      R"xml(<node pkg="lifecycle" exec="lifecycle_talker" name="talker">
              <watch kind="lifecycle" timeout="1" on_unhealthy="shutdown"/></node>)xml");
  EXPECT_THAT(result.err + result.out,
              ContainsRegex("process is unhealthy: it has not been active for [0-9.]+ s: '/talker/get_state' says "
                            "unconfigured"));
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
}

TEST_F(Watches, ANodeThatIsActiveIsHealthy) {
  const CommandResult result = launch(
      R"xml(<node pkg="lifecycle" exec="lifecycle_talker" name="talker">
              <watch kind="lifecycle" timeout="2" start_period="30"/></node>
            <lifecycle_transition node="talker" transitions="configure activate"/>)xml" +
      end_when_healthy("talker"));
  EXPECT_THAT(result.out, HasSubstr("it is healthy\n"));
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(Watches, OneClientServesAllWatchesAndItsEndIsNoFailure) {
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, write(node("ever", R"xml(
      <watch kind="topic" topic="/beats" timeout="2"/>
      <watch kind="service" service="/hanging_node/get_parameters" timeout="2"/>)xml") +
                                                        R"xml(<executable cmd="echo it is healthy" output="screen">
                   <depends_on process="node" condition="healthy" timeout="30"/></executable>)xml")}});
  ASSERT_TRUE(launch.wait_for_output("process started", kPatience));
  // Below the launcher, which is below the two guardians.
  const auto clients = [&] {
    return run_command(
               {"sh", "-c", "pgrep -x launch-ros-clie -P $(pgrep -P $(pgrep -P " + std::to_string(launch.pid()) + "))"})
        .out;
  };
  ASSERT_TRUE(launch.wait_for_output("it is healthy", kPatience));
  EXPECT_THAT(clients(), ContainsRegex("^[0-9]+\n$"));
  run_command({"kill", "-KILL", clients().substr(0, clients().find('\n'))});
  ASSERT_TRUE(launch.wait_for_output("can't be watched: launch-ros-client was ended by SIGKILL", kPatience));
  // The launch starts another one.
  while (clients().empty()) {  // the time of the test is the limit
  }
  const CommandResult result = launch.end_gently();
  EXPECT_THAT(result.out + result.err, Not(HasSubstr("unhealthy")));
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(Watches, FindsAPortThatIsClosed) {
  const CommandResult result = launch(script(R"py(
import socket, time
server = socket.create_server(('127.0.0.1', 45871))
time.sleep(1)
server.close()
time.sleep(1000)
)py",
                                             R"xml(<watch kind="port" port="45871" interval="0.2" start_period="20"
                                                          on_unhealthy="shutdown"/>)xml"));
  EXPECT_THAT(result.err + result.out, HasSubstr("process is unhealthy: localhost:45871 does not accept connections: "
                                                 "Connection refused"));
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
}

TEST_F(Watches, AProcessIsHealthyWhenItsPortsAndSocketAccept) {
  const std::string path = sandbox_.directory() / "map.sock";
  const CommandResult result = launch(script(R"py(
import socket, time
server = socket.create_server(('::1', 45872), family=socket.AF_INET6)
datagrams = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
datagrams.bind(('0.0.0.0', 45873))
local = socket.socket(socket.AF_UNIX)
local.bind(')py" + path + R"py(')
local.listen()
time.sleep(1000)
)py",
                                             R"xml(<watch kind="port" port="45872" interval="0.2" start_period="20"/>
                   <watch kind="port" port="45873" protocol="udp" interval="0.2" start_period="20"/>
                   <watch kind="port" socket=")xml" +
                                                 path + R"xml(" interval="0.2" start_period="20"/>)xml") +
                                      end_when_healthy("script"));
  EXPECT_THAT(result.out, HasSubstr("it is healthy\n"));
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

constexpr const char* kNotify = R"py(
import os, socket, time
def notify(text):
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as out:
        out.sendto(text.encode(), os.environ['NOTIFY_SOCKET'])
)py";

TEST_F(Watches, ReadyOfANotificationIsWhatOthersWaitFor) {
  const CommandResult result = launch(script(std::string(kNotify) + R"py(
print('loading')
time.sleep(0.5)
print('loaded')
notify('READY=1\nSTATUS=at work')
time.sleep(1000)
)py",
                                             R"xml(<watch kind="notify" timeout="20"/>)xml") +
                                      end_when_healthy("script"));
  EXPECT_THAT(result.out, ContainsRegex("loaded\n(.|\n)*it is healthy\n"));
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(Watches, FindsAProcessWithTooMuchMemory) {
  const CommandResult result =
      launch(script("import time\nheld = b'x' * 150000000\ntime.sleep(1000)\n",
                    R"xml(<watch kind="memory" max_memory="100M" timeout="0.5" on_unhealthy="shutdown"/>)xml"));
  EXPECT_THAT(
      result.err + result.out,
      ContainsRegex("process is unhealthy: it has had more than 100.0 MiB of memory for [0-9.]+ s, now 1[0-9.]+ MiB"));
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
}

TEST_F(Watches, FindsAProcessThatNeverRests) {
  const CommandResult result = launch(
      script("while True: pass\n", R"xml(<watch kind="load" max_load="5%" timeout="1" on_unhealthy="shutdown"/>)xml"));
  EXPECT_THAT(result.err + result.out,
              ContainsRegex("process is unhealthy: it has used [0-9]+ % of a processor for [0-9.]+ s"));
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
}

TEST_F(Watches, FindsAProcessThatIsNotReadyInTime) {
  const CommandResult result = launch(
      script("import time\ntime.sleep(1000)\n", R"xml(<watch kind="notify" timeout="1" on_unhealthy="shutdown"/>)xml"));
  EXPECT_THAT(result.err + result.out,
              ContainsRegex("process is unhealthy: it has not said that it is ready \\(READY=1\\) for [0-9.]+ s"));
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
}

TEST_F(Watches, FindsAProcessThatFeedsItsWatchdogNoMore) {
  const CommandResult result = launch(script(std::string(kNotify) + R"py(
print('watchdog', os.environ['WATCHDOG_USEC'])
notify('READY=1')
for i in range(20):
    notify('WATCHDOG=1')
    time.sleep(0.1)
print('that was all')
time.sleep(1000)
)py",
                                             R"xml(<watch kind="notify" watchdog="true" timeout="1.5"
                                                          start_period="20" on_unhealthy="shutdown"/>)xml"));
  EXPECT_THAT(result.out, HasSubstr("watchdog 1500000\n"));
  EXPECT_THAT(result.out + result.err,
              ContainsRegex("that was all\n(.|\n)*process is unhealthy: it has not said that it lives \\(WATCHDOG=1\\) "
                            "for 1\\.[0-9] s"));
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
}

TEST_F(Watches, TheStatusOfAProcessIsInPsAndNothingIsLeftOfItsSocket) {
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, write(script(std::string(kNotify) + R"py(
notify('READY=1\nSTATUS=12 maps loaded')
time.sleep(1000)
)py",
                                                               R"xml(<watch kind="notify" timeout="30"/>)xml"))}});
  ASSERT_TRUE(launch.wait_for_output("process started", kPatience));
  RunningCommand events({.argv = {LAUNCH_PROGRAM, "events"}});
  std::string table;
  while (table.find("maps") == std::string::npos) {  // the time of the test is the limit
    table = run_command({LAUNCH_PROGRAM, "ps"}).out;
  }
  EXPECT_THAT(table, HasSubstr("running, healthy (12 maps loaded)"));
  EXPECT_THAT(run_command({LAUNCH_PROGRAM, "ps", "--json"}).out, ContainsRegex("\"status\": *\"12 maps loaded\""));
  ::kill(launch.pid(), SIGKILL);
  launch.wait(kPatience);
  Sandbox::wait_until_daemons_are_left();
  for (const auto& entry : fs::recursive_directory_iterator(sandbox_.directory())) {
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("notify-")));
  }
}

TEST_F(Watches, AStopByTheTerminalIsNoFailure) {
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, write(node("ever", R"xml(
      <watch kind="topic" topic="/beats" min_rate="5" timeout="1"/>
      <watch kind="service" service="/hanging_node/get_parameters" timeout="1"/>)xml"))}});
  ASSERT_TRUE(launch.wait_for_output("tick 40", kPatience));
  launch.send_signal(SIGTSTP);
  // The launch stops itself and all its processes.
  run_command({"sleep", "4"});
  launch.send_signal(SIGCONT);
  ASSERT_TRUE(launch.wait_for_output("tick 100", kPatience));
  launch.send_signal(SIGINT);
  const CommandResult result = launch.wait(kPatience);
  EXPECT_THAT(result.out + result.err, Not(HasSubstr("unhealthy")));
  EXPECT_EQ(result.exit_code, 0);
}

}  // namespace
