// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/ps_answer.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "launcher/control/control_client.hpp"

namespace launch {
namespace {

using testing::ElementsAre;

std::string why_refused(std::string_view line) {
  try {
    read_ps_answer(line);
  } catch (const ControlError& error) {
    return std::string(error.what()) + "|" + error.help();
  }
  return "";
}

TEST(PsAnswer, HasWhatTheLaunchSaysOfItselfAndItsProcesses) {
  const ListedLaunch launch = read_ps_answer(
      R"({"version":1,"ok":true,"launch":{"pid":7,"state":"running","files":["/a.launch.xml","-"],"command":["x"],)"
      R"("started":12.5,"running_for":90.5,"isolation":"namespaces"},"processes":[)"
      R"({"name":"talker-1","names":["talker","/talker"],"state":"running","pid":8,"running_for":1.5,"restarts":2,)"
      R"("last_end":{"signal":"SIGSEGV","ran_for":0.5},"place":{"file":"/a.launch.xml","line":3,"column":5}},)"
      R"({"name":"b-2","names":[],"state":"ended","restarts":0,"last_end":{"exit_code":4,"ran_for":1},)"
      R"("place":{"file":"/b.launch.xml","line":9,"column":1}},)"
      R"({"name":"c","names":["c"],"state":"waiting","place":null}]})");
  EXPECT_EQ(launch.pid, 7);
  EXPECT_EQ(launch.state, "running");
  EXPECT_THAT(launch.files, ElementsAre("/a.launch.xml", "-"));
  EXPECT_EQ(launch.running_for, 90.5);
  EXPECT_EQ(launch.isolation, "namespaces");
  ASSERT_EQ(launch.processes.size(), 3U);

  const ListedProcess& talker = launch.processes[0];
  EXPECT_EQ(talker.name, "talker-1");
  EXPECT_EQ(talker.state, "running");
  EXPECT_EQ(talker.pid, 8);
  EXPECT_EQ(talker.running_for, 1.5);
  EXPECT_EQ(talker.restarts, 2);
  EXPECT_EQ(talker.end, "SIGSEGV");
  EXPECT_EQ(launch.places.at(talker.file), "/a.launch.xml");
  EXPECT_EQ(talker.line, 3);

  const ListedProcess& ended = launch.processes[1];
  EXPECT_EQ(ended.pid, -1);
  EXPECT_EQ(ended.end, "exit code 4");
  EXPECT_EQ(launch.places.at(ended.file), "/b.launch.xml");

  const ListedProcess& waiting = launch.processes[2];
  EXPECT_EQ(waiting.state, "waiting");
  EXPECT_EQ(waiting.restarts, -1);
  EXPECT_EQ(waiting.line, 0);
}

TEST(PsAnswer, HasTheMachinesOfProcesses) {
  const ListedLaunch launch = read_ps_answer(
      R"({"version":1,"ok":true,"launch":{"pid":7,"state":"running"},"processes":[)"
      R"({"name":"talker-1","names":[],"state":"running","machine":"arm","away":true,"pid_there":8,"place":null},)"
      R"({"name":"b-2","names":[],"state":"running","machine":"base","pid_there":9,"place":null}]})");
  ASSERT_EQ(launch.processes.size(), 2U);
  EXPECT_EQ(launch.processes[0].machine, "arm");
  EXPECT_TRUE(launch.processes[0].away);
  EXPECT_EQ(launch.processes[0].pid_there, 8);
  EXPECT_EQ(launch.processes[1].machine, "base");
  EXPECT_FALSE(launch.processes[1].away);
}

TEST(PsAnswer, SkipsWhatALaterLauncherAdds) {
  const ListedLaunch launch = read_ps_answer(
      R"({"version":1,"ok":true,"new":{"processes":[{"name":"no"}],"ok":false},"launch":{"pid":7,"files":[],)"
      R"("more":{"pid":1,"files":["no"]}},"processes":[{"name":"a","more":{"name":"no","pid":1},"pids":[2],"pid":3}]})");
  EXPECT_EQ(launch.pid, 7);
  EXPECT_THAT(launch.files, testing::IsEmpty());
  ASSERT_EQ(launch.processes.size(), 1U);
  EXPECT_EQ(launch.processes[0].name, "a");
  EXPECT_EQ(launch.processes[0].pid, 3);
}

TEST(PsAnswer, TellsOfEachProcessAsSoonAsItIsRead) {
  std::vector<std::string> read;
  read_ps_answer(R"({"ok":true,"processes":[{"name":"a","place":{"line":1}},{"name":"b","last_end":{"exit_code":0}}]})",
                 [&](const ListedProcess& process) { read.push_back(process.name); });
  EXPECT_THAT(read, ElementsAre("a", "b"));
}

TEST(PsAnswer, TellsARefusal) {
  EXPECT_EQ(why_refused(R"({"version":1,"ok":false,"error":"no process is named 'x'","help":"did you mean 'y'?"})"),
            "no process is named 'x'|did you mean 'y'?");
  EXPECT_EQ(why_refused(R"({"version":1,"ok":false})"), "the launch has given no reason|");
  EXPECT_EQ(why_refused("HTTP/1.1 400 Bad Request"), "the launch speaks another language|");
  EXPECT_EQ(why_refused(R"(["ok"])"), "the launch speaks another language|");
}

}  // namespace
}  // namespace launch
