// SPDX-License-Identifier: Apache-2.0
// Components in real containers: loaded, traced, loaded again, refused, waited for.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <cerrno>
#include <regex>
#include <utility>

#include "launch_trace_testing/matchers.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace launch_trace_testing;
using namespace test_support;
using testing::HasSubstr;

class Composition : public testing::Test {
 protected:
  std::string write(const std::string& actions) {
    const auto path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }

  static std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
      ++found;
    }
    return found;
  }

  Sandbox sandbox_;
};

constexpr const char* kTalker =
    R"xml(<composable_node pkg="composition" plugin="composition::Talker" name="talker"/>)xml";

std::string container(const std::string& attributes, const std::string& nodes) {
  return "<node_container pkg=\"rclcpp_components\" exec=\"component_container\" name=\"c\" namespace=\"\" " +
         attributes + ">" + nodes + "</node_container>";
}

TEST_F(Composition, NodesOfAContainerAreInTheTraceAndTheLaunchersClientIsNot) {
  const std::string file = write(R"xml(<trace session-name="t" context-fields="procname vpid vtid"
subbuffer-size-ust="1048576"/>)xml" +
                                 container("", kTalker) + R"xml(
<load_composable_node target="c">
  <composable_node pkg="composition" plugin="composition::Listener" name="listener" namespace="ear"/>
</load_composable_node>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("Loaded node '/talker' in container '/c'")) << run.out() << run.err();
  ASSERT_TRUE(run.wait_for_output("Loaded node '/ear/listener' in container 'c'")) << run.out() << run.err();
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");

  const Trace trace(sandbox_.trace_directory() / "t");
  // The trace has the launcher's own events, but no events of its client for the ROS graph.
  EXPECT_THAT(trace, EachEvent(event(""), event("").that("is of the launcher or the container", [](const Event& event) {
                return event.procname() == (event.name().starts_with("launch:") ? "launch" : "component_conta");
              })));
  for (const auto& [name, name_space] :
       {std::pair("c", "/"), std::pair("talker", "/"), std::pair("listener", "/ear")}) {
    EXPECT_THAT(trace, HasEvent(event("ros2:rcl_node_init").with("node_name", name).with("namespace", name_space)));
  }
}

TEST_F(Composition, AContainerThatStartsAgainGetsItsNodesAgain) {
  RunningCommand run({.argv = {LAUNCH_PROGRAM, write(container("respawn=\"true\"", kTalker))}});
  ASSERT_TRUE(run.wait_for_output("Loaded node '/talker'")) << run.out() << run.err();
  std::smatch match;
  const std::string out = run.out();
  ASSERT_TRUE(std::regex_search(out, match, std::regex("process started with pid \\[(\\d+)\\]")));
  ASSERT_EQ(::kill(std::stoi(match[1]), SIGTERM), 0);
  ASSERT_TRUE(run.wait_for_output("process has finished cleanly"));
  for (int i = 0; i < 500 && count(run.out(), "Loaded node '/talker'") < 2; ++i) {
    run.wait_for_output("no such line", std::chrono::milliseconds(100));
  }
  EXPECT_EQ(count(run.out(), "Loaded node '/talker' in container '/c'"), 2U) << run.out();
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(Composition, AContainerThatIsKilledGetsItsNodesAgain) {
  RunningCommand run({.argv = {LAUNCH_PROGRAM, write(container("respawn=\"true\"", kTalker))}});
  const std::regex started("process started with pid \\[(\\d+)\\]");
  constexpr std::size_t kKills = 3;
  for (std::size_t loads = 1; loads <= kKills + 1; ++loads) {
    for (int i = 0; i < 500 && count(run.out(), "Loaded node '/talker' in container '/c'") < loads; ++i) {
      run.wait_for_output("no such line", std::chrono::milliseconds(100));
    }
    const std::string out = run.out();
    ASSERT_EQ(count(out, "Loaded node '/talker' in container '/c'"), loads) << out;
    std::string last_pid;
    for (std::sregex_iterator match(out.begin(), out.end(), started); match != std::sregex_iterator(); ++match) {
      last_pid = (*match)[1];
    }
    if (loads <= kKills) {
      ASSERT_EQ(::kill(std::stoi(last_pid), SIGKILL), 0);
    }
  }
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 3);
}

TEST_F(Composition, WhatCannotBeLoadedIsSaidAndTheLaunchGoesOn) {
  const std::string file = write(container("", R"xml(
<composable_node pkg="composition" plugin="composition::Nobody" name="nobody"/>
<composable_node pkg="no_such_package" plugin="a::B" name="b"/>
)xml" + std::string(kTalker)));
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("Loaded node '/talker'")) << run.out() << run.err();
  EXPECT_THAT(run.out(), HasSubstr("Failed to load node 'nobody' of type 'composition::Nobody' in container '/c': "
                                   "Failed to find class with the requested plugin name. (" +
                                   file + ":3:2)"));
  EXPECT_THAT(run.out(), HasSubstr("Failed to load node 'b' of type 'a::B' in container '/c': "
                                   "Could not find requested resource in ament index (" +
                                   file + ":4:2)"));
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out,
              HasSubstr("[ERROR] [launch]: component 'nobody' of type 'composition::Nobody' was not loaded (" + file +
                        ":3:2)\n[ERROR] [launch]: component 'b' of type 'a::B' was not loaded ("));
}

TEST_F(Composition, AContainerOfSomebodyElseIsGivenNodes) {
  RunningCommand owner({.argv = {LAUNCH_PROGRAM, write(container("output=\"screen\"", ""))}});
  ASSERT_TRUE(owner.wait_for_output("process started with pid")) << owner.out() << owner.err();
  const auto file = sandbox_.directory() / "guest.launch.xml";
  write_file(
      file, "<launch><load_composable_node target=\"/c\">" + std::string(kTalker) + "</load_composable_node></launch>");
  const CommandResult guest = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(guest.exit_code, 0) << guest.err << "\nthe owner of the container: " << owner.out() << owner.err();
  EXPECT_THAT(guest.out, HasSubstr("Loaded node '/talker' in container '/c'"));
  EXPECT_TRUE(owner.wait_for_output("[talker]: Publishing: 'Hello World: 1'"));
  owner.send_signal(SIGINT);
  EXPECT_EQ(owner.wait().exit_code, 0);
}

TEST_F(Composition, AKilledLauncherLeavesNobodyBehind) {
  RunningCommand run({.argv = {LAUNCH_PROGRAM, write(container("", kTalker))}});
  ASSERT_TRUE(run.wait_for_output("Loaded node '/talker'")) << run.out() << run.err();
  run.send_signal(SIGKILL);
  EXPECT_EQ(run.wait().signal, SIGKILL);
  // Container, guardian and ROS client become our children and end by themselves.
  while (::waitpid(-1, nullptr, 0) > 0) {
  }
  EXPECT_EQ(errno, ECHILD);
}

TEST_F(Composition, ACtrlCEndsTheWaitForAContainerThatNeverComes) {
  const std::string file = write("<log message=\"asking\"/><load_composable_node target=\"/nobody\">" +
                                 std::string(kTalker) + "</load_composable_node>");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("asking"));
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("[launch_ros.actions.load_composable_nodes]: Abandoning wait for the "
                                    "'/nobody/_container/load_node' service, due to shutdown."));
}

}  // namespace
