// SPDX-License-Identifier: Apache-2.0
// Handlers of the states of nodes, and handlers that are unregistered. On virtual time.
#include "launcher/run/handlers/state_handlers.hpp"

#include "launcher/ros/fake/fake_ros_client.hpp"
#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using test_support::FakeRosClient;
using testing::ElementsAre;
using testing::IsEmpty;

class StateHandlersTest : public LaunchServiceTest {
 protected:
  StateHandlersTest() { client = &client_; }

  // The client reports the change at this time, to this number of watches.
  void change_at(Duration time, std::string from, std::string to, int watches) {
    timers_.push_back(loop_.after(time, [this, from = std::move(from), to = std::move(to), watches] {
      EXPECT_EQ(client_.change_state("/left/n", from, to), watches);
    }));
  }

  FakeRosClient client_{loop_};
  std::vector<EventLoop::SourcePtr> timers_;
};

TEST_F(StateHandlersTest, AreVisitedForTheStatesThatTheyAskFor) {
  runner_.default_script({.exits_after = 10s});
  change_at(1s, "unconfigured", "configuring", 1);
  change_at(2s, "configuring", "inactive", 1);
  change_at(3s, "inactive", "activating", 1);
  change_at(4s, "configuring", "inactive", 1);
  EXPECT_EQ(run(R"xml(<executable cmd="n"/><push_ros_namespace namespace="left"/>
<on_state_transition node="n" goal_state="inactive" once="true"><log message="configured"/></on_state_transition>
<on_state_transition node="/left/n" start_state="inactive"><log message="leaves inactive"/></on_state_transition>
<on_state_transition node="n"><log message="$(var event.node): $(var event.start_state) to $(var event.goal_state)"/>
</on_state_transition>)xml"),
            0);
  EXPECT_THAT(messages_, ElementsAre("[launch.user] /left/n: unconfigured to configuring", "[launch.user] configured",
                                     "[launch.user] /left/n: configuring to inactive", "[launch.user] leaves inactive",
                                     "[launch.user] /left/n: inactive to activating",
                                     "[launch.user] /left/n: configuring to inactive"));
}

TEST_F(StateHandlersTest, MayChangeTheStateFurther) {
  runner_.default_script({.exits_after = 5s});
  change_at(1s, "configuring", "inactive", 1);
  client_.script("change /left/n activate", FakeRosClient::loaded(""));
  EXPECT_EQ(run(R"xml(<executable cmd="n"/><on_state_transition node="/left/n" goal_state="inactive">
<lifecycle_transition node="/left/n" transitions="activate"/></on_state_transition>)xml"),
            0);
  EXPECT_THAT(client_.asked, ElementsAre("the state of '/left/n'", "change /left/n activate"));
  EXPECT_THAT(messages_, IsEmpty());
}

TEST_F(StateHandlersTest, KeepNothingAlive) {
  runner_.default_script({.exits_after = 1s});
  EXPECT_EQ(run(R"xml(<executable cmd="n"/><on_state_transition node="n"><shutdown/></on_state_transition>)xml"), 0);
  EXPECT_EQ(loop_.now(), 1s);
}

TEST_F(StateHandlersTest, WithoutAClientAreAnError) {
  client = nullptr;
  EXPECT_EQ(run(R"xml(<on_state_transition node="n"><log message="never"/></on_state_transition>)xml"), 1);
  EXPECT_THAT(errors_,
              ElementsAre(R"(/test/system.launch.xml:2:2: error: there is no ROS client to watch the states of nodes
    2 | <on_state_transition node="n"><log message="never"/></on_state_transition>
      |  ^~~~~~~~~~~~~~~~~~~)"));
}

TEST_F(StateHandlersTest, RefuseStatesThatDoNotExist) {
  try {
    run(R"xml(<on_state_transition node="n" goal_state="activ"/>)xml");
    FAIL();
  } catch (const LaunchError& error) {
    EXPECT_STREQ(error.what(),
                 R"(/test/system.launch.xml:2:43: error: a node with a managed life cycle has no state 'activ'
    2 | <on_state_transition node="n" goal_state="activ"/>
      |                                           ^~~~~
      = help: did you mean 'active'?)");
  }
}

TEST_F(StateHandlersTest, AndOthersHearNothingMoreOnceUnregistered) {
  runner_.script("a", {{.exits_after = 10s, .output = {{.at = 1s, .text = "one\n"}, {.at = 3s, .text = "two\n"}}}});
  change_at(4s, "inactive", "activating", 0);
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>
<on_process_io name="lines" pattern="."><log message="$(var event.text)"/></on_process_io>
<on_state_transition name="states" node="/left/n"><log message="never"/></on_state_transition>
<timer period="2"><unregister_event_handler name="lines"/><unregister_event_handler name="states"/></timer>)xml"),
            0);
  EXPECT_THAT(messages_, ElementsAre("[launch.user] one"));
}

TEST_F(StateHandlersTest, UnregisteringAnotherHandlerOfAnEventStopsItFromTheNextOn) {
  runner_.script("a", {{.exits_after = 5s, .output = {{.at = 1s, .text = "one\ntwo\n"}}}});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>
<on_process_io process="a" pattern="one"><unregister_event_handler name="second"/></on_process_io>
<on_process_io process="a"><log message="first: $(var event.text)"/></on_process_io>
<on_process_io process="a" name="second"><log message="second: $(var event.text)"/></on_process_io>)xml"),
            0);
  EXPECT_THAT(messages_,
              ElementsAre("[launch.user] first: one", "[launch.user] second: one", "[launch.user] first: two"));
}

TEST_F(StateHandlersTest, TheLaunchIsNotIdleBeforeTheLastHandlerOfAnEvent) {
  runner_.default_script({.exits_after = 1s});
  EXPECT_EQ(run(R"xml(<executable cmd="n"/>
<on_process_exit process="n"><log message="first"/></on_process_exit>
<on_process_exit process="n"><shutdown reason="done"/></on_process_exit>
<on_shutdown><log message="$(var event.reason)"/></on_shutdown>)xml"),
            0);
  EXPECT_THAT(messages_, ElementsAre("[launch.user] first", "[launch.user] done"));
}

TEST_F(StateHandlersTest, ANodesHandlersHearOfAChangeTogether) {
  runner_.default_script({.exits_after = 10s});
  change_at(1s, "unconfigured", "configuring", 1);
  change_at(2s, "configuring", "inactive", 1);
  EXPECT_EQ(run(R"xml(<executable cmd="n"/>
<on_state_transition node="/left/n"><unregister_event_handler name="second"/><log message="first"/></on_state_transition>
<on_state_transition node="/left/n" name="second"><log message="second"/></on_state_transition>)xml"),
            0);
  EXPECT_THAT(client_.asked, ElementsAre("the state of '/left/n'"));
  EXPECT_THAT(messages_, ElementsAre("[launch.user] first", "[launch.user] second", "[launch.user] first",
                                     "[launch] no event handler is registered that is named 'second' "
                                     "(/test/system.launch.xml:3:69)"));
}

TEST_F(StateHandlersTest, UnregisteringWhatIsNotThereIsAWarning) {
  EXPECT_EQ(run(R"xml(<unregister_event_handler name="x"/>)xml"), 0);
  EXPECT_THAT(messages_,
              ElementsAre("[launch] no event handler is registered that is named 'x' (/test/system.launch.xml:2:33)"));
}

}  // namespace
}  // namespace launch
