// SPDX-License-Identifier: Apache-2.0
// Loads components and changes states as a launch does: order, messages, respawn, shutdown. On virtual time.
#include "launcher/ros/ros_tasks.hpp"

#include <gmock/gmock.h>
#include <signal.h>

#include "actions/builtin_actions.hpp"
#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/process/fake/fake_process_runner.hpp"
#include "launcher/ros/fake/fake_ros_client.hpp"
#include "launcher/run/launch_service.hpp"

namespace {

using namespace launch;
using namespace std::chrono_literals;
using test_support::FakeRosClient;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

RosAnswer done() {
  return FakeRosClient::loaded("");
}

class RosTasksTest : public testing::Test {
 protected:
  int run(const std::string& actions, bool with_client = true) {
    const auto file = std::make_shared<SourceFile>("/test/system.launch.xml", "<launch>\n" + actions + "\n</launch>");
    LaunchContext context(registry_, {{"PATH", "/bin"}}, "",
                          [this](LogLevel level, std::string_view logger, std::string_view text) {
                            const char* const name = level == LogLevel::kError     ? "ERROR"
                                                     : level == LogLevel::kWarning ? "WARNING"
                                                                                   : "INFO";
                            messages_.push_back(fmt::format("{} [{}] {}", name, logger, text));
                          });
    LaunchService service(context, loop_, supervisor_,
                          [this](const LaunchError& error) { errors_.emplace_back(error.what()); });
    if (with_client) {
      service.use_ros_client(client_);
    }
    return service.run(*parse_launch_description(file, registry_));
  }

  std::vector<std::string> messages_;
  std::vector<std::string> errors_;
  Registry registry_ = builtin_actions();
  FakeEventLoop loop_;
  FakeProcessRunner runner_{loop_};
  OutputRouter output_{[] {
    OutputRouter::Options options;
    options.screen_fd = -1;
    return options;
  }()};
  ProcessSupervisor supervisor_{loop_, runner_, output_};
  FakeRosClient client_{loop_};
};

constexpr const char* kTwoInAContainer = R"xml(<node_container exec="container" name="c" namespace="left">
<composable_node pkg="p" plugin="p::A" name="a"/>
<composable_node pkg="p" plugin="p::B" name="b"/>
</node_container>)xml";

TEST_F(RosTasksTest, ComponentsOfOneActionAreLoadedOneAfterAnother) {
  runner_.default_script({.exits_after = 60s});
  const auto first = loop_.after(1s, [this] {
    EXPECT_THAT(client_.asked, ElementsAre("load /left/c a"));
    EXPECT_TRUE(client_.answer_pending("load /left/c a", FakeRosClient::loaded("/a")));
  });
  const auto second = loop_.after(2s, [this] {
    EXPECT_THAT(client_.asked, ElementsAre("load /left/c a", "load /left/c b"));
    EXPECT_TRUE(client_.answer_pending("load /left/c b", FakeRosClient::loaded("/b")));
  });
  EXPECT_EQ(run(kTwoInAContainer), 0);
  EXPECT_THAT(messages_, ElementsAre("INFO [launch_ros.actions.load_composable_nodes] Loaded node '/a' in container "
                                     "'/left/c'",
                                     "INFO [launch_ros.actions.load_composable_nodes] Loaded node '/b' in container "
                                     "'/left/c'"));
  EXPECT_TRUE(client_.closed);
}

TEST_F(RosTasksTest, TheComponentsOfAContainerThatCannotStartAreGivenUp) {
  runner_.script("container", {{.spawn_error = ENOENT}});
  EXPECT_EQ(run(kTwoInAContainer), 3);
  EXPECT_THAT(messages_, testing::Contains(HasSubstr("Failed to load node 'a' of type 'p::A' in container '/left/c': "
                                                     "its process does not run")));
  EXPECT_LT(loop_.now(), 1s);
}

TEST_F(RosTasksTest, NothingIsLoadedWhenARequiredProcessCannotStart) {
  runner_.default_script({.exits_after = 60s});
  runner_.script("missing", {{.spawn_error = ENOENT}});
  EXPECT_EQ(run(std::string(R"xml(<executable cmd="missing" on_exit="shutdown"/>)xml") + kTwoInAContainer), 3);
  EXPECT_LT(loop_.now(), 10s);
}

TEST_F(RosTasksTest, ActionsLoadSideBySide) {
  const auto answers = loop_.after(1s, [this] {
    EXPECT_THAT(client_.asked, ElementsAre("load /x a", "load /y b"));
    EXPECT_TRUE(client_.answer_pending("load /y b", FakeRosClient::loaded("/b")));
    EXPECT_TRUE(client_.answer_pending("load /x a", FakeRosClient::loaded("/a")));
  });
  // There is no process: the launch lasts until everything is loaded.
  EXPECT_EQ(
      run(R"xml(<load_composable_node target="x"><composable_node pkg="p" plugin="A" name="a"/></load_composable_node>
<load_composable_node target="/y"><composable_node pkg="p" plugin="B" name="b"/></load_composable_node>)xml"),
      0);
  EXPECT_EQ(loop_.now(), 1s);
  EXPECT_THAT(messages_, ElementsAre(HasSubstr("Loaded node '/b' in container '/y'"),
                                     HasSubstr("Loaded node '/a' in container 'x'")));
}

TEST_F(RosTasksTest, AComponentThatCannotBeLoadedIsAnErrorOfTheLogAndTheNextIsTried) {
  runner_.default_script({.exits_after = 60s});
  client_.script("load /left/c a", FakeRosClient::refused("Could not find requested resource in ament index\n"));
  client_.script("load /left/c b", FakeRosClient::loaded("/b"));
  EXPECT_EQ(run(kTwoInAContainer), 3);
  EXPECT_THAT(messages_,
              ElementsAre("ERROR [launch_ros.actions.load_composable_nodes] Failed to load node 'a' of type "
                          "'p::A' in container '/left/c': Could not find requested resource in ament index "
                          "(/test/system.launch.xml:3:2)",
                          HasSubstr("Loaded node '/b'"),
                          "ERROR [launch] component 'a' of type 'p::A' was not loaded (/test/system.launch.xml:3:2)"));
}

TEST_F(RosTasksTest, AContainerThatStartsAgainGetsItsComponentsAgain) {
  runner_.script("container", {{.exits_after = 5s, .exit_code = -11}, {.exits_after = 60s}});
  client_.script("load /c a", FakeRosClient::loaded("/a"));
  client_.script("load /c b", FakeRosClient::loaded("/b"));
  EXPECT_EQ(run(R"xml(<node_container exec="container" name="c" namespace="" respawn="true" respawn_max_retries="1">
<composable_node pkg="p" plugin="A" name="a"/></node_container>
<load_composable_node target="c"><composable_node pkg="p" plugin="B" name="b"/></load_composable_node>)xml"),
            3);  // its crash counts although it was started again
  EXPECT_THAT(client_.asked, ElementsAre("load /c a", "load /c b", "load /c a", "load /c b"));
}

TEST_F(RosTasksTest, WhatWaitsForAContainerThatHasEndedIsGivenUp) {
  runner_.default_script({.exits_after = 3s, .exit_code = 1});
  EXPECT_EQ(run(kTwoInAContainer), 3);
  EXPECT_EQ(loop_.now(), 3s);
  EXPECT_THAT(client_.asked, ElementsAre("load /left/c a"));
  EXPECT_THAT(messages_,
              ElementsAre("ERROR [launch_ros.actions.load_composable_nodes] Failed to load node 'a' of type 'p::A' in "
                          "container '/left/c': its process does not run (/test/system.launch.xml:3:2)",
                          "ERROR [launch_ros.actions.load_composable_nodes] Failed to load node 'b' of type 'p::B' in "
                          "container '/left/c': its process does not run (/test/system.launch.xml:4:2)",
                          "ERROR [launch] 1 process has failed:",
                          "ERROR [launch]   container-1: exit code 1 after 3.00 s, with 0.00 s of processor time and "
                          "0.0 MiB (/test/system.launch.xml:2:2)",
                          "ERROR [launch] component 'a' of type 'p::A' was not loaded (/test/system.launch.xml:3:2)",
                          "ERROR [launch] component 'b' of type 'p::B' was not loaded (/test/system.launch.xml:4:2)"));
}

TEST_F(RosTasksTest, WhatWaitsForAContainerThatIsSkippedIsGivenUp) {
  runner_.default_script({.exits_after = 3s, .exit_code = 1});
  EXPECT_EQ(run(R"xml(<executable cmd="calibrate"/>
<node_container exec="container" name="c" namespace="">
<composable_node pkg="p" plugin="p::A" name="a"/>
<depends_on process="calibrate" condition="exited" on_failure="skip"/>
</node_container>)xml"),
            3);
  EXPECT_EQ(loop_.now(), 3s);
  EXPECT_THAT(messages_,
              testing::Contains("ERROR [launch_ros.actions.load_composable_nodes] Failed to load node 'a' of "
                                "type 'p::A' in container '/c': its process does not run "
                                "(/test/system.launch.xml:4:2)"));
  EXPECT_EQ(messages_.back(),
            "ERROR [launch] component 'a' of type 'p::A' was not loaded (/test/system.launch.xml:4:2)");
}

TEST_F(RosTasksTest, ALongWaitIsToldAndAShutdownEndsIt) {
  const auto interrupt = loop_.after(15s, [this] { loop_.deliver_signal(SIGINT); });
  EXPECT_EQ(
      run(R"xml(<load_composable_node target="c"><composable_node pkg="p" plugin="A" name="a"/></load_composable_node>)xml"),
      0);
  EXPECT_THAT(messages_, ElementsAre("WARNING [launch_ros.actions.load_composable_nodes] still waiting for the "
                                     "'/c/_container/load_node' service (/test/system.launch.xml:2:35)",
                                     "WARNING [launch] user interrupted with ctrl-c (SIGINT)",
                                     "WARNING [launch_ros.actions.load_composable_nodes] Abandoning wait for the "
                                     "'/c/_container/load_node' service, due to shutdown."));
  EXPECT_TRUE(client_.closed);
}

TEST_F(RosTasksTest, ALifecycleNodeIsConfiguredThenActivatedAtEveryStart) {
  runner_.script("n", {{.exits_after = 5s}, {.exits_after = 5s}});
  client_.script("change /n configure", done());
  client_.script("change /n activate", done());
  EXPECT_EQ(run(R"xml(<lifecycle_node exec="n" name="n" namespace="" autostart="true" respawn="true"
respawn_max_retries="1"/>)xml"),
            0);
  EXPECT_THAT(client_.asked,
              ElementsAre("change /n configure", "change /n activate", "change /n configure", "change /n activate"));
  EXPECT_THAT(messages_, IsEmpty());
}

TEST_F(RosTasksTest, ATransitionThatFailsEndsTheRow) {
  runner_.default_script({.exits_after = 5s});
  client_.script("change /n configure", FakeRosClient::refused(""));
  EXPECT_EQ(run(R"xml(<lifecycle_node exec="n" name="n" namespace="" autostart="true"/>)xml"), 0);
  EXPECT_THAT(client_.asked, ElementsAre("change /n configure"));
  EXPECT_THAT(messages_, ElementsAre("ERROR [launch_ros.utilities.lifecycle_event_manager] Failed to make transition "
                                     "'configure' for LifecycleNode '/n' (/test/system.launch.xml:2:2)"));
}

TEST_F(RosTasksTest, AComponentWithAutostartIsActivatedWhileTheNextIsLoaded) {
  runner_.default_script({.exits_after = 60s});
  client_.script("load /c a", FakeRosClient::loaded("/ns/a"));
  client_.script("load /c b", FakeRosClient::loaded("/b"));
  client_.script("change /ns/a configure", done());
  client_.script("change /ns/a activate", done());
  EXPECT_EQ(run(R"xml(<node_container exec="container" name="c" namespace="">
<composable_lifecycle_node pkg="p" plugin="A" name="a" namespace="ns" autostart="true"/>
<composable_lifecycle_node pkg="p" plugin="B" name="b"/></node_container>)xml"),
            0);
  EXPECT_THAT(client_.asked, ElementsAre("load /c a", "change /ns/a configure", "load /c b", "change /ns/a activate"));
}

TEST_F(RosTasksTest, AProcessMayWaitForWhatTheGraphShows) {
  runner_.default_script({.exits_after = 1s});
  const auto first = loop_.after(2s, [this] { EXPECT_TRUE(client_.answer_pending("the '/s' service", done())); });
  const auto second = loop_.after(3s, [this] { EXPECT_TRUE(client_.answer_pending("'/n' to be active", done())); });
  EXPECT_EQ(run(R"xml(<executable cmd="planner"><depends_on service="s"/>
<depends_on node="n" state="active"/></executable>)xml"),
            0);
  ASSERT_EQ(runner_.spawned().size(), 1U);
  EXPECT_EQ(runner_.spawned().at(0).at, 3s);
}

TEST_F(RosTasksTest, ActionsMayWaitForWhatTheGraphShows) {
  runner_.default_script({.exits_after = 5s});
  client_.script("change /n activate", done());
  const auto ready = loop_.after(2s, [this] {
    EXPECT_THAT(client_.asked, ElementsAre("'/n' to be inactive"));
    EXPECT_TRUE(client_.answer_pending("'/n' to be inactive", done()));
  });
  EXPECT_EQ(run(R"xml(<executable cmd="driver"/>
<wait_for node="n" state="inactive"><lifecycle_transition node="n" transitions="activate"/>
  <log message="now"/></wait_for>)xml"),
            0);
  EXPECT_THAT(client_.asked, ElementsAre("'/n' to be inactive", "change /n activate"));
  EXPECT_THAT(messages_, ElementsAre("INFO [launch.user] now"));
}

TEST_F(RosTasksTest, AWaitKeepsNothingAlive) {
  EXPECT_EQ(run(R"xml(<wait_for topic="t"><executable cmd="late"/></wait_for>)xml"), 0);
  EXPECT_EQ(loop_.now(), 0s);
  EXPECT_EQ(runner_.spawned().size(), 0U);
}

TEST_F(RosTasksTest, AWaitForTheGraphHasItsTimeOut) {
  EXPECT_EQ(
      run(R"xml(<executable cmd="planner"><depends_on topic="t" condition="message" timeout="2"/></executable>)xml"),
      1);
  EXPECT_EQ(loop_.now(), 2s);
  EXPECT_THAT(errors_, ElementsAre(HasSubstr("a message has come on '/t'")));
  EXPECT_EQ(runner_.spawned().size(), 0U);
}

TEST_F(RosTasksTest, WithoutAClientTheLaunchFails) {
  RosAnswer lost;
  lost.client_lost = true;
  lost.error = "cannot start launch-ros-client: No such file or directory";
  client_.script("load /left/c a", lost);
  EXPECT_EQ(run(kTwoInAContainer), 1);
  EXPECT_THAT(errors_, ElementsAre(HasSubstr("/test/system.launch.xml:3:2: error: cannot start launch-ros-client: No "
                                             "such file or directory")));
  EXPECT_EQ(runner_.signals().at(0).signal, SIGINT);
}

}  // namespace
