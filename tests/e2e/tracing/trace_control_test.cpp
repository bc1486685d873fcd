// SPDX-License-Identifier: Apache-2.0
// The effects of <trace> in a launch: the launcher's own events, processes that stay out, snapshots when something goes
// wrong.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/support/sanitized.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

bool counters_are_left() {
  const fs::directory_iterator files("/dev/shm");
  return std::any_of(begin(files), end(files), [](const fs::directory_entry& file) {
    return file.path().filename().string().rfind("launch-event-counters", 0) == 0;
  });
}

class TraceControl : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& actions) const {
    const fs::path path = sandbox_.directory() / name;
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }

  // The lines that babeltrace2 prints for events whose name begins with `prefix`.
  static std::vector<std::string> events(const fs::path& directory, const std::string& prefix) {
    const CommandResult read = run_command({"babeltrace2", directory.string()});
    EXPECT_EQ(read.exit_code, 0) << read.err;
    std::vector<std::string> lines;
    std::istringstream out(read.out);
    for (std::string line; std::getline(out, line);) {
      const std::size_t end = line.find(": {");
      if (end != std::string::npos && line.substr(line.rfind(' ', end) + 1).starts_with(prefix)) {
        lines.push_back(line);
      }
    }
    return lines;
  }

  // The directories of the snapshots of a session.
  std::vector<fs::path> snapshots(const std::string& session) const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(sandbox_.trace_directory() / session)) {
      found.push_back(entry.path());
    }
    return found;
  }

  Sandbox sandbox_;
};

TEST_F(TraceControl, WhatTheLauncherDoesIsInTheTraceWithTheLineThatAskedForIt) {
  const std::string part = write("part.launch.xml", R"xml(<executable name="second" cmd="true"/>)xml");
  const std::string file = write("system.launch.xml", R"xml(<trace session-name="run"/>
<include file="part.launch.xml"/>
<executable name="first" cmd="false" respawn="true" respawn_max_retries="1">
  <depends_on process="second" condition="exited"/>
</executable>
<executable name="lasting" cmd="sleep 1000"/>
<on_process_exit process="first" once="true"><on_process_exit process="first"><shutdown/></on_process_exit></on_process_exit>)xml");
  const CommandResult result = run_command({.argv = {LAUNCH_PROGRAM, file}, .directory = sandbox_.directory()});
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;

  const std::vector<std::string> lines = events(sandbox_.trace_directory() / "run", "launch:");
  const auto of = [&lines](const std::string& event) {
    std::vector<std::string> found;
    for (const std::string& line : lines) {
      if (line.find(" launch:" + event + ": {") != std::string::npos) {
        found.push_back(line);
      }
    }
    return found;
  };
  const auto place = [](const std::string& path, int line) {
    return "file = \"" + path + "\", line = " + std::to_string(line) + " }";
  };
  ASSERT_THAT(of("load"), SizeIs(1));
  EXPECT_THAT(of("load")[0], AllOf(HasSubstr("name = \"" + file + "\""), ContainsRegex("duration = [1-9][0-9]+")));
  ASSERT_THAT(of("include"), SizeIs(1));
  EXPECT_THAT(of("include")[0], AllOf(HasSubstr("name = \"part.launch.xml\""), HasSubstr(place(file, 3))));
  EXPECT_THAT(of("visit"), SizeIs(3)) << "the file, and what handlers hold";
  EXPECT_THAT(of("spawn"), SizeIs(3));
  ASSERT_THAT(of("exec"), SizeIs(4)) << "one runs twice";
  EXPECT_THAT(of("exec")[0], AllOf(HasSubstr("process = \"second-1\""), HasSubstr(place(part, 2))));
  ASSERT_THAT(of("respawn"), SizeIs(1));
  EXPECT_THAT(of("respawn")[0],
              AllOf(HasSubstr("process = \"first-3\""), HasSubstr("exit_code = 1"), HasSubstr(place(file, 4))));
  EXPECT_THAT(of("exit"), SizeIs(4));
  ASSERT_THAT(of("signal"), SizeIs(1));
  EXPECT_THAT(of("signal")[0], AllOf(HasSubstr("process = \"lasting-2\""), HasSubstr("signal = 2")));
  EXPECT_THAT(lines.back(), AllOf(HasSubstr("launch:exit"), HasSubstr("exit_code = -2")));
}

TEST_F(TraceControl, WhatAProcessWaitsForIsRecordedWhenItIsThere) {
  const std::string file = write("system.launch.xml", R"xml(<trace session-name="run"/>
<executable name="server" cmd="echo up"/>
<executable name="client" cmd="true">
  <depends_on process="server" condition="output" pattern="up"/>
</executable>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const std::vector<std::string> lines = events(sandbox_.trace_directory() / "run", "launch:");
  const auto index = [&lines](const std::string& event, const std::string& process) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].find(" launch:" + event + ": {") != std::string::npos &&
          lines[i].find("process = \"" + process + "\"") != std::string::npos) {
        return i;
      }
    }
    return lines.size();
  };
  const std::size_t ready = index("ready", "client");
  ASSERT_LT(ready, lines.size());
  EXPECT_THAT(lines[ready], HasSubstr(R"(condition = "\'server\' has written a line that matches \'up\'", file = ")" +
                                      file + "\", line = 5 }"))
      << "babeltrace2 escapes the quotes";
  EXPECT_LT(index("exec", "server-1"), ready);
  EXPECT_LT(ready, index("spawn", "client"));
}

TEST_F(TraceControl, LaunchEventsCanBeLeftOut) {
  const std::string file = write("system.launch.xml", R"xml(<trace session-name="run" launch-events="false"/>
<executable cmd="sh -c ')xml" TRACED_APP R"xml( 3 10 &lt;/dev/null'"/>)xml");
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, file}).exit_code, 0);
  EXPECT_THAT(events(sandbox_.trace_directory() / "run", "launch:"), IsEmpty());
  EXPECT_THAT(events(sandbox_.trace_directory() / "run", "ros2:"), SizeIs(4));
}

TEST_F(TraceControl, ProcessesThatAreNotToBeTracedAreSilent) {
  if (test_support::kSanitized) {
    GTEST_SKIP() << test_support::kMallocIsTaken;
  }
  const std::string app = std::string("sh -c '") + TRACED_APP + " 3 10 &lt;/dev/null'";
  const std::string file =
      write("system.launch.xml",
            "<trace session-name=\"run\" events-ust=\"*\" nodes=\"loud other\"/>\n<executable name=\"loud\" cmd=\"" +
                app + "\"/>\n<executable name=\"quiet\" cmd=\"" + app +
                "\"/>\n<executable name=\"other\" trace=\"false\" cmd=\"" + app + "\"/>");
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, file}).exit_code, 0);
  std::map<std::string, std::string> pids;  // of the applications, by label
  EXPECT_THAT(events(sandbox_.trace_directory() / "run", "ros2:"), SizeIs(4)) << "of one of three";
  std::set<std::string> processes;
  for (const std::string& line : events(sandbox_.trace_directory() / "run", "")) {
    const std::size_t begin = line.find("procname = \"") + 12;
    processes.insert(line.substr(begin, line.find('"', begin) - begin));
  }
  EXPECT_EQ(processes.count("traced_app"), 1u);
}

// The subshells of a shell are forked, but execute no program. For the tracer each is a process of its own, and ends.
TEST_F(TraceControl, ForkedProcessesAreTracedAsTheirOwn) {
  const fs::path script = sandbox_.directory() / "script.sh";
  write_file(script, "for i in 1 2 3 4; do echo $(echo $i); done\n");
  const std::string file = write("system.launch.xml", R"xml(
<trace session-name="run" events-ust="lttng_ust_libc:*" context-fields="vpid"/>
<executable cmd="bash )xml" + script.string() + "\"/>");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 0) << result.out;
  std::set<std::string> processes;
  for (const std::string& line : events(sandbox_.trace_directory() / "run", "lttng_ust_libc:")) {
    const std::size_t begin = line.find("vpid = ");
    processes.insert(line.substr(begin, line.find_first_of(" ,", begin + 7) - begin));
  }
  EXPECT_THAT(processes, SizeIs(5));
}

// A trace that asks for them gets them also beside one that does not.
TEST_F(TraceControl, TellsWhereTheFilesOfAProcessAreLoaded) {
  const std::string file = write("system.launch.xml", R"xml(
<trace session-name="plain" events-ust="ros2:*"/>
<trace session-name="run" events-ust="ros2:* lttng_ust_statedump:bin_info"/>
<executable cmd="sh -c ')xml" TRACED_APP R"xml( 1 1 &lt;/dev/null'"/>)xml");
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, file}).exit_code, 0);
  EXPECT_THAT(events(sandbox_.trace_directory() / "run", "lttng_ust_statedump:bin_info"),
              testing::Contains(HasSubstr("path = \"" TRACED_APP "\"")));
}

TEST_F(TraceControl, NodesThatNothingIsCalledAreWarnedOf) {
  const std::string file = write("system.launch.xml", R"xml(<trace session-name="run" nodes="talkr"/>
<executable name="talker" cmd="true"/>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("[WARNING] [launch.trace]: nothing that is launched now is called 'talkr', which "
                                    "'nodes' names"));
}

// Twenty processes die within a second. Each fires its last event just before, and this event is in a snapshot.
TEST_F(TraceControl, TheLastEventBeforeEachOfTwentyCrashesIsInASnapshot) {
  std::string actions =
      "<trace session-name=\"run\" snapshot-on-crash=\"true\" snapshot-limit=\"40\" events-ust=\"ros2:*\"/>\n";
  constexpr int kCrashes = 20;
  for (int i = 0; i < kCrashes; ++i) {
    actions += "<timer period=\"" + std::to_string(0.3 + i * 0.03) + "\"><executable name=\"c" + std::to_string(i) +
               "\" cmd=\"" TRACED_APP " 1 " + std::to_string(i) + " abort\"/></timer>\n";
  }
  const CommandResult result = run_command({LAUNCH_PROGRAM, write("system.launch.xml", actions)});
  EXPECT_EQ(result.exit_code, 3) << result.out;
  EXPECT_THAT(result.out, ContainsRegex("snapshot written to: .*/run/snapshot-.* \\(c[0-9]+-[0-9]+ died of SIGABRT"));

  std::set<std::size_t> seen;  // by the length of the text in the last event
  for (const fs::path& snapshot : snapshots("run")) {
    EXPECT_THAT(read_file(snapshot / "verdict.json"), HasSubstr("died of SIGABRT"));
    for (const std::string& line : events(snapshot, "ros2:rclcpp_callback_register")) {
      const std::size_t begin = line.find("symbol = \"") + 10;
      seen.insert(line.find('"', begin) - begin);
    }
  }
  EXPECT_THAT(seen, SizeIs(kCrashes));
}

// LTTng-UST would give a stopped daemon three seconds, three times, before main().
TEST_F(TraceControl, AProcessThatDiesWithinAnEventIsToldOfWhileTheOthersRun) {
  const std::string file = write("system.launch.xml", R"xml(<trace session-name="run"/>
<executable name="planner" cmd=")xml" INTERRUPTED_APP R"xml( 20 die"/>
<executable name="other" cmd="sleep 1000"/>)xml");
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(launch.wait_for_output("[launch.trace]: planner-1 died within an event: what processor "))
      << launch.out();
  EXPECT_THAT(
      run_command({LAUNCH_PROGRAM, "trace", "status", "run"}).out,
      ContainsRegex("  processor [0-9]+: a process died within an event; what is recorded there is lost, for "));
  launch.send_signal(SIGINT);
  EXPECT_THAT(launch.wait().out + launch.err(), HasSubstr("trace is incomplete: unfinished:"));
}

TEST_F(TraceControl, AStoppedDaemonDoesNotHoldUpProcessesThatStartLater) {
  const std::string file = write("system.launch.xml", R"xml(<trace session-name="run"/>
<executable name="first" cmd="sleep 1000"/>
<on_process_exit process="first">
  <executable name="second" output="screen" cmd=")xml" TRACED_APP R"xml( 3 10"/>
</on_process_exit>)xml");
  ASSERT_EQ(run_command({"lttng-sessiond", "--daemonize"}).exit_code, 0);  // our child, not that of a guardian
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  const std::string started = "[first-1]: process started with pid [";
  ASSERT_TRUE(run.wait_for_output(started)) << run.out() << run.err();
  const pid_t first = std::stoi(run.out().substr(run.out().find(started) + started.size()));
  const pid_t daemon =
      std::stoi(read_file(geteuid() == 0 ? "/run/lttng/lttng-sessiond.pid"
                                         : std::string(getenv("LTTNG_HOME")) + "/.lttng/lttng-sessiond.pid"));
  kill(daemon, SIGSTOP);
  ASSERT_EQ(waitpid(daemon, nullptr, WUNTRACED), daemon);
  kill(first, SIGKILL);
  ASSERT_TRUE(run.wait_for_output("process started with pid [")) << "the second";
  EXPECT_TRUE(run.wait_for_output("fired", std::chrono::seconds(8))) << run.out();
  kill(daemon, SIGCONT);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 3);
}

TEST_F(TraceControl, NoMoreSnapshotsAreKeptThanAskedFor) {
  std::string actions = "<trace session-name=\"run\" snapshot-on-crash=\"true\" snapshot-limit=\"2\"/>\n";
  for (int i = 0; i < 5; ++i) {
    actions += "<timer period=\"" + std::to_string(0.2 + i * 0.2) +
               "\"><executable cmd=\"" TRACED_APP " 1 5 abort\"/></timer>\n";
  }
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, write("system.launch.xml", actions)}).exit_code, 3);
  EXPECT_THAT(snapshots("run"), SizeIs(2));
}

TEST_F(TraceControl, SnapshotsAreTakenOnASignalAndOnAnEvent) {
  const std::string file =
      write("system.launch.xml", R"xml(<trace session-name="run" snapshot-on-signal="SIGUSR1" events-ust="ros2:*"
       snapshot-on-events="'ros2:rclcpp_callback_register if callback == 2'"/>
<executable name="app" output="screen" cmd=")xml" TRACED_APP R"xml( 1 10"/>
<timer period="0.2"><executable name="late" output="screen" cmd=")xml" TRACED_APP R"xml( 2 10"/></timer>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("(event ros2:rclcpp_callback_register if callback == 2)")) << run.out() << run.err();
  run.send_signal(SIGUSR1);
  ASSERT_TRUE(run.wait_for_output("(SIGUSR1)")) << run.out() << run.err();
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
  EXPECT_THAT(snapshots("run"), SizeIs(testing::Ge(2u)));
  EXPECT_THAT(run_command({"lttng", "list-triggers"}).out, testing::Not(HasSubstr("run:")));
}

// The threads of the trace before must not take the signal.
TEST_F(TraceControl, ASnapshotIsTakenOnASignalBesideAnotherTrace) {
  const std::string file = write("system.launch.xml", R"xml(<trace session-name="whole"/>
<trace session-name="run" snapshot-on-signal="SIGUSR1"/>
<executable name="app" output="screen" cmd=")xml" TRACED_APP R"xml( 1 10"/>
<timer period="60"><shutdown/></timer>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("fired")) << run.out() << run.err();
  run.send_signal(SIGUSR1);
  ASSERT_TRUE(run.wait_for_output("(SIGUSR1)")) << run.out() << run.err();
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
  EXPECT_THAT(snapshots("run"), SizeIs(1));
}

TEST_F(TraceControl, AKilledLauncherLeavesNoTriggerAndNoSession) {
  const std::string file =
      write("system.launch.xml", R"xml(<trace session-name="run" snapshot-on-events="ros2:rcl_init"/>
<executable name="app" output="screen" cmd=")xml" TRACED_APP R"xml( 1 10"/>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("(event ros2:rcl_init)")) << run.out() << run.err();
  EXPECT_THAT(run_command({"lttng", "list-triggers"}).out, HasSubstr("run:0"));
  run.send_signal(SIGKILL);
  EXPECT_EQ(run.wait().signal, SIGKILL);
  sandbox_.wait_until_daemons_are_left();
  EXPECT_THAT(run_command({"lttng", "list"}).out, HasSubstr("Currently no available recording session"));
  EXPECT_THAT(run_command({"lttng", "list-triggers"}).out, testing::Not(HasSubstr("run:")));
  EXPECT_FALSE(counters_are_left());
}

TEST_F(TraceControl, TheNetworkExampleSendsItsTraceToTheRelayDaemon) {
  const fs::path relayed = sandbox_.directory() / "relayed";
  ASSERT_EQ(run_command({"lttng-relayd", "--daemonize", "--output=" + relayed.string()}).exit_code, 0);
  for (const std::string format : {"xml", "yaml"}) {
    const CommandResult result = run_command({LAUNCH_PROGRAM, EXAMPLES_DIRECTORY "/25_network.launch." + format});
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    EXPECT_THAT(result.out, HasSubstr("trace written to: net://127.0.0.1"));
    EXPECT_THAT(result.out, HasSubstr("trace is complete: no events lost"));
    EXPECT_FALSE(events(relayed, "ros2:rcl_node_init").empty());
    fs::remove_all(relayed);
  }
}

// As in a container that runs before the launch.
TEST_F(TraceControl, AProgramWithSharedMemoryOfItsOwnIsToldOf) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root there is no second /dev/shm";
  }
  const std::string apart = "mount -t tmpfs none /dev/shm && exec " TRACED_APP " 5 10";
  RunningCommand before({.argv = {"unshare", "-m", "sh", "-c", apart}});
  ASSERT_TRUE(before.wait_for_output("fired"));
  const std::string file = write("system.launch.xml", R"xml(<trace session-name="run"/>
<executable cmd="sleep 1000"/>)xml");
  RunningCommand launcher({.argv = {LAUNCH_PROGRAM, file}});
  EXPECT_TRUE(launcher.wait_for_output(
      "process " + std::to_string(before.pid()) +
      " (traced_app) is not recorded: it has a /dev/shm of its own and started before the session daemon; share "
      "/dev/shm (docker run --ipc=host), or start it again"));
  launcher.send_signal(SIGINT);
  launcher.wait();
  before.close_input();
  EXPECT_EQ(before.wait().exit_code, 0);
}

TEST_F(TraceControl, WhatSnapshotsAreTakenOnIsChecked) {
  const std::string file =
      write("system.launch.xml", R"xml(<trace session-name="run" snapshot-on-signal="SIGKILL"/>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr(":2:47: error: snapshot-on-signal is expected to be SIGUSR1 or SIGUSR2, got "
                                    "'SIGKILL'"));
}

}  // namespace
