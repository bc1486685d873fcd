// SPDX-License-Identifier: Apache-2.0
// The commands that ask a running launch, with real processes: launch ps, stop, start, restart, signal, shutdown,
// events, logs.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/e2e/command_line/control_fixture.hpp"

namespace {

using namespace test_support;
using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
namespace fs = std::filesystem;

TEST_F(Control, PsListsProcessesWithTheirStatesAndPlaces) {
  const std::string file = write(kTalker + "\n" + R"xml(<executable name="broken" shell="true" cmd="exit 3"/>
<executable name="later" cmd="true"><depends_on process="talker" condition="exited"/></executable>)xml");
  RunningCommand run(launch({file}));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience)) << run.out() << run.err();
  ASSERT_TRUE(run.wait_for_output("[broken-2]: process has died", kPatience));
  const CommandResult listed = ask({"ps"});
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  EXPECT_THAT(listed.out, MatchesRegex("launch [0-9]+: system.launch.xml, running for [0-9:]+, 3 processes\n"
                                       "NAME +STATE +PID +RESTARTS +CPU +MEMORY +TIME +PLACE\n"
                                       "talker-1 +running +[0-9]+ +0 +[0-9.]+ % +[0-9.]+ [KM]iB +[0-9:]+  "
                                       "system.launch.xml:2\n"
                                       "broken-2 +ended: exit code 3 +- +0 +- +- +-  system.launch.xml:4\n"
                                       "later +waiting +- +- +- +- +-  system.launch.xml:5\n"));
  const json all = ps();
  EXPECT_EQ(all["version"], 1);
  ASSERT_EQ(all["launches"].size(), 1U);
  const json& launch = all["launches"][0]["launch"];
  EXPECT_EQ(launch["pid"], run.pid());
  EXPECT_EQ(launch["files"], json::array({file}));
  EXPECT_EQ(launch["state"], "running");
  const json& talker = all["launches"][0]["processes"][0];
  EXPECT_EQ(talker["name"], "talker-1");
  EXPECT_EQ(talker["names"], json::array({"talker"}));
  EXPECT_GT(talker["memory"], 0);
  EXPECT_EQ(talker["place"]["line"], 2);
  EXPECT_THAT(run.out(), HasSubstr("process started with pid [" + talker["pid"].dump() + "]"));

  EXPECT_THAT(ask({"ps", "tal*"}).out, Not(HasSubstr("broken")));
  EXPECT_EQ(ask({"complete", "stop", "tal"}).out, "talker\ntalker-1\n");
  EXPECT_EQ(ask({"complete", "signal", "talker", "SIGUSR"}).out, "SIGUSR1\nSIGUSR2\n");
  const CommandResult unknown = ask({"ps", "talkr"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_EQ(unknown.err, "launch ps: error: no process is named 'talkr'\n      = help: did you mean 'talker'?\n");
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 3) << "one has failed";
}

TEST_F(Control, StopStartAndRestartWaitUntilItHasHappened) {
  const std::string file = write(kTalker + "\n" + kSleeper);
  RunningCommand run(launch({file}));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience));
  CommandResult result = ask({"stop", "sleeper"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "sleeper-2 has ended: SIGINT\n");
  EXPECT_EQ(ps()["launches"][0]["processes"][1]["state"], "ended") << "it would respawn otherwise";
  result = ask({"stop", "sleeper"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "launch stop: error: sleeper-2 does not run\n");
  result = ask({"start", "sleeper-2"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, MatchesRegex("sleeper-2 has started, pid [0-9]+\n"));
  result = ask({"restart", "s*", "t*"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("talker-1 has started, pid "));
  EXPECT_THAT(result.out, HasSubstr("sleeper-2 has started, pid "));
  EXPECT_EQ(ps()["launches"][0]["processes"][1]["restarts"], 2);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
  EXPECT_THAT(run.out(), HasSubstr("[INFO] [launch]: launch restart: talker-1, sleeper-2\n"));
}

TEST_F(Control, AProcessThatCantStartAgainIsAnError) {
  const fs::path program = sandbox_.directory() / "program";
  write_file(program, "#!/bin/sh\necho up\nexec sleep 1000\n");
  fs::permissions(program, fs::perms::owner_all);
  const std::string file =
      write(kTalker + R"xml(<executable name="program" output="both" cmd=")xml" + program.string() + R"xml("/>)xml");
  RunningCommand run(launch({file}));
  ASSERT_TRUE(run.wait_for_output("[program-2] up", kPatience));
  fs::remove(program);
  const CommandResult result = ask({"restart", "program"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("launch restart: error: program-2 has not started: "));
  EXPECT_THAT(result.err, HasSubstr("No such file or directory"));
  run.send_signal(SIGINT);
  run.wait();
}

TEST_F(Control, ASignalReachesTheProcess) {
  RunningCommand run(launch({write(kTalker)}));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience));
  const CommandResult result = ask({"signal", "talker", "USR1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "talker-1 got SIGUSR1\n");
  EXPECT_TRUE(run.wait_for_output("sending signal 'SIGUSR1' to process[talker-1]", kPatience));
  EXPECT_TRUE(run.wait_for_output("[talker-1] got USR1", kPatience));
  const CommandResult wrong = ask({"signal", "talker", "SIGUSR3"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err,
              HasSubstr("launch signal: error: there is no signal 'SIGUSR3'\n      = help: did you mean 'SIGUSR"));
  EXPECT_EQ(ask({"signal", "talker"}).exit_code, 2);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(Control, ShutdownReturnsWhenNothingIsLeft) {
  RunningCommand run(launch({write(kTalker)}));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience));
  const CommandResult result = ask({"shutdown"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "launch " + std::to_string(run.pid()) + " has ended\n");
  siginfo_t ended{};
  EXPECT_EQ(::waitid(P_PID, static_cast<id_t>(run.pid()), &ended, WEXITED | WNOHANG | WNOWAIT), 0);
  EXPECT_EQ(ended.si_pid, run.pid()) << "it has ended already";
  EXPECT_EQ(run.wait().exit_code, 0);
  EXPECT_THAT(run.out(), HasSubstr("[INFO] [launch]: ending the launch, by launch shutdown\n"));
  EXPECT_THAT(sockets(), testing::IsEmpty());
}

TEST_F(Control, WithoutALaunchThereIsAnError) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{{"ps"},
                                                                                     {"stop", "a"},
                                                                                     {"start", "a"},
                                                                                     {"restart", "a"},
                                                                                     {"signal", "a", "INT"},
                                                                                     {"shutdown"},
                                                                                     {"events"},
                                                                                     {"logs"}}) {
    const CommandResult result = ask(words);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err, "launch " + words.front() + ": error: no launch runs\n");
  }
  EXPECT_EQ(ask({"stop"}).exit_code, 2);
  EXPECT_EQ(json::parse(ask({"ps", "--json"}).out), json::parse(R"({"version": 1, "launches": []})"));
}

TEST_F(Control, OneOfSeveralLaunchesIsChosenByNumberOrFile) {
  RunningCommand left(launch({write(kTalker, "left.launch.xml")}));
  RunningCommand right(launch({write(kTalker, "right.launch.xml")}));
  ASSERT_TRUE(left.wait_for_output("[talker-1] ready", kPatience));
  ASSERT_TRUE(right.wait_for_output("[talker-1] ready", kPatience));
  EXPECT_EQ(ps()["launches"].size(), 2U);
  CommandResult result = ask({"stop", "talker"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("launch stop: error: several launches run; choose one with --launch NUMBER:\n"));
  EXPECT_THAT(result.err, ContainsRegex("  " + std::to_string(left.pid()) + " +left.launch.xml\n"));
  EXPECT_THAT(result.err, ContainsRegex("  " + std::to_string(right.pid()) + " +right.launch.xml\n"));
  result = ask({"shutdown", "--launch", "right"});
  EXPECT_THAT(result.err, HasSubstr("launch shutdown: error: launch 'right' does not run; there are:\n"));
  result = ask({"shutdown", "--launch", "right.launch.xml"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(right.wait().exit_code, 0);
  EXPECT_EQ(ask({"shutdown", "--launch", std::to_string(left.pid())}).exit_code, 0);
  EXPECT_EQ(left.wait().exit_code, 0);
}

TEST_F(Control, EventsAreLinesOfJsonUntilTheEnd) {
  RunningCommand run(launch({write(kTalker + "\n" + kSleeper)}));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience));
  RunningCommand events(launch({"events", "-f"}));
  // The first event shows that it follows.
  for (bool follows = false; !follows;) {
    ASSERT_EQ(ask({"signal", "talker", "CONT"}).exit_code, 0);
    follows = events.wait_for_output("SIGCONT", std::chrono::milliseconds(200));
  }
  ask({"restart", "sleeper"});
  ask({"shutdown"});
  const CommandResult result = events.wait(kPatience);
  EXPECT_EQ(result.exit_code, 0);
  std::vector<std::string> seen;
  for (std::size_t begin = 0, end = 0; (end = result.out.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const json event = json::parse(result.out.substr(begin, end - begin));
    EXPECT_GT(event["time"], 1'600'000'000.0);
    if (event.value("signal", "") != "SIGCONT") {
      seen.push_back(event.value("process", "") + " " + event["event"].get<std::string>());
    }
  }
  const std::vector<std::string> first(seen.begin(), seen.begin() + std::min<std::ptrdiff_t>(4, std::ssize(seen)));
  EXPECT_THAT(first, testing::ElementsAre("sleeper-2 signalled", "sleeper-2 exited", "sleeper-2 started", " ending"));
  EXPECT_THAT(seen, testing::IsSupersetOf({"talker-1 exited", "talker-1 done", "sleeper-2 exited", "sleeper-2 done"}));
  run.wait();
}

TEST_F(Control, LogsShowWhatWasPrintedAndGoOn) {
  RunningCommand run(launch({write(R"xml(<executable name="echo" shell="true" output="log"
      cmd="more() { echo more; }; trap more USR1; echo first; echo second; echo third; while :; do read x; done"/>
      <executable name="other" shell="true" output="log" cmd="echo unheard; exec sleep 1000"/>)xml")}));
  ASSERT_TRUE(run.wait_for_output("[other-2]: process started", kPatience));
  const auto wait_for_log = [&](const std::vector<std::string>& words, const std::string& text) {
    CommandResult result;
    for (const auto end = std::chrono::steady_clock::now() + kPatience;
         std::chrono::steady_clock::now() < end && result.out.find(text) == std::string::npos;) {
      result = ask(words);
    }
    return result.out;
  };
  EXPECT_THAT(wait_for_log({"logs"}, "unheard"), HasSubstr("[other-2] unheard\n"));
  EXPECT_EQ(wait_for_log({"logs", "echo"}, "third"), "[echo-1] first\n[echo-1] second\n[echo-1] third\n");
  EXPECT_EQ(ask({"logs", "-n", "2", "echo"}).out, "[echo-1] second\n[echo-1] third\n");
  RunningCommand follower(launch({"logs", "-f", "-n", "1", "ech*"}));
  ASSERT_TRUE(follower.wait_for_output("[echo-1] third\n", kPatience));
  ask({"signal", "echo", "USR1"});
  EXPECT_TRUE(follower.wait_for_output("[echo-1] more\n", kPatience));
  ask({"shutdown"});
  const CommandResult result = follower.wait(kPatience);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, Not(HasSubstr("unheard")));
  EXPECT_EQ(ask({"logs", "-n", "many"}).err,
            "launch logs: error: --lines needs a number\n      = help: see 'launch logs --help'\n");
  run.wait();
}

TEST_F(Control, GarbageIsAnsweredWithAnError) {
  RunningCommand run(launch({write(kTalker)}));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience));
  ASSERT_EQ(sockets().size(), 1U);
  const fs::path path = runtime_ / "launch" / sockets().front();
  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  // A relative address, because the path may be too long for one.
  const fs::path before = fs::current_path();
  fs::current_path(path.parent_path());
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, sockets().front().c_str(), sizeof address.sun_path - 1);
  const int client = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(::connect(client, reinterpret_cast<sockaddr*>(&address), sizeof address), 0) << std::strerror(errno);
  fs::current_path(before);
  const std::string garbage = "GET / HTTP/1.1\r\n\r\n{\"version\":9}\n\x01\x02\xff\n{\"version\":1,\"do\":\"info\"}\n";
  ASSERT_EQ(::send(client, garbage.data(), garbage.size(), 0), static_cast<ssize_t>(garbage.size()));
  std::string answers;
  while (std::count(answers.begin(), answers.end(), '\n') < 5) {
    std::array<char, 4096> bytes{};
    const ssize_t count = ::recv(client, bytes.data(), bytes.size(), 0);
    ASSERT_GT(count, 0);
    answers.append(bytes.data(), static_cast<std::size_t>(count));
  }
  ::close(client);
  EXPECT_THAT(answers, MatchesRegex("(\\{\"version\":1,\"ok\":false,\"error\":[^\n]*\n){4}"
                                    "\\{\"version\":1,\"ok\":true,\"launch\":[^\n]*\n"));
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(Control, AKilledLauncherLeavesNoSocket) {
  RunningCommand run(launch({write(kTalker)}));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience));
  ASSERT_EQ(sockets().size(), 1U);
  const pid_t launcher = launcher_below(run.pid());
  ASSERT_EQ(::kill(launcher, SIGKILL), 0);
  EXPECT_EQ(run.wait(kPatience).signal, SIGKILL);
  EXPECT_THAT(sockets(), testing::IsEmpty());
  EXPECT_EQ(ask({"ps"}).err, "launch ps: error: no launch runs\n");
}

TEST_F(Control, ASocketThatNobodyListensToIsRemoved) {
  fs::create_directory(runtime_ / "launch");
  fs::permissions(runtime_ / "launch", fs::perms::owner_all);
  const fs::path before = fs::current_path();
  fs::current_path(runtime_ / "launch");
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strcpy(address.sun_path, "1-0123456789abcdef.sock");
  const int dead = ::socket(AF_UNIX, SOCK_STREAM, 0);
  EXPECT_EQ(::bind(dead, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ::close(dead);
  fs::current_path(before);
  ASSERT_EQ(sockets().size(), 1U);
  EXPECT_EQ(ask({"ps"}).err, "launch ps: error: no launch runs\n");
  EXPECT_THAT(sockets(), testing::IsEmpty());
}

}  // namespace
