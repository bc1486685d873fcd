// SPDX-License-Identifier: Apache-2.0
// Managed nodes in a launch: they are started automatically, waited for, and led through their states. Also the
// conditions of the graph for the start of a process.
#include <gmock/gmock.h>
#include <signal.h>

#include "tests/support/command.hpp"
#include "tests/support/recorded_trace.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class LifecycleLaunch : public testing::Test {
 protected:
  std::string write(const std::string& actions) {
    const auto path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }

  Sandbox sandbox_;
};

TEST_F(LifecycleLaunch, ANodeIsLedThroughItsStatesAndTheTraceTellsThem) {
  const std::string file = write(R"xml(
    <trace session-name="t" context-fields="procname vpid vtid" subbuffer-size-ust="1048576"/>
    <lifecycle_node pkg="lifecycle" exec="lifecycle_talker" name="talker" namespace="left" autostart="true"/>
    <executable name="late" cmd="echo the talker is active" output="screen">
      <depends_on node="/left/talker" state="active" timeout="30"/>
    </executable>
    <on_process_exit process="late">
      <lifecycle_transition node="/left/talker" transitions="deactivate cleanup shutdown"/>
    </on_process_exit>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("on shutdown is called from state unconfigured.")) << run.out() << run.err();
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("waits until '/left/talker' is active"));
  EXPECT_LT(result.out.find("on_activate() is called."), result.out.find("the talker is active"));
  EXPECT_THAT(result.out, Not(HasSubstr("Failed to make transition")));

  std::vector<std::string> transitions;
  for (const RecordedEvent& event : read_trace(sandbox_.trace_directory() / "t").events) {
    if (event.name == "ros2:rcl_lifecycle_transition") {
      transitions.push_back(event.text("start_label") + " to " + event.text("goal_label"));
    }
  }
  EXPECT_THAT(transitions,
              ElementsAre("unconfigured to configuring", "configuring to inactive", "inactive to activating",
                          "activating to active", "active to deactivating", "deactivating to inactive",
                          "inactive to cleaningup", "cleaningup to unconfigured", "unconfigured to shuttingdown",
                          "shuttingdown to finalized"));
}

TEST_F(LifecycleLaunch, AComponentIsStartedAutomaticallyToo) {
  const std::string file = write(R"xml(
    <node_container pkg="rclcpp_components" exec="component_container" name="c" namespace="">
      <composable_lifecycle_node pkg="lifecycle" plugin="lifecycle::LifecycleTalker" name="talker" autostart="true"/>
    </node_container>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  EXPECT_TRUE(run.wait_for_output("[talker]: on_activate() is called.")) << run.out() << run.err();
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(LifecycleLaunch, ATransitionThatTheStateForbidsIsAnErrorOfTheLog) {
  const std::string file =
      write(R"xml(<lifecycle_node pkg="lifecycle" exec="lifecycle_talker" name="talker" namespace=""/>
<lifecycle_transition node="talker" transitions="activate"/>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  EXPECT_TRUE(
      run.wait_for_output("[launch_ros.utilities.lifecycle_event_manager]: Failed to make transition "
                          "'activate' for LifecycleNode '/talker' (" +
                          file + ":3:2)"))
      << run.out() << run.err();
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(LifecycleLaunch, AProcessStartsOnceTheGraphShowsWhatItNeeds) {
  const std::string file = write(R"xml(
    <node pkg="demo_nodes" exec="talker"><depends_on process="first" condition="exited"/></node>
    <executable name="first" cmd="true"/>
    <executable name="message" cmd="echo heard" output="screen" on_exit="shutdown">
      <depends_on node="talker" timeout="30"/>
      <depends_on topic="chatter" timeout="30"/>
      <depends_on service="talker/get_parameters" timeout="30"/>
      <depends_on topic="chatter" condition="message" timeout="30"/>
    </executable>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_LT(result.out.find("Publishing: 'Hello World: 1'"), result.out.find("heard"));
}

TEST_F(LifecycleLaunch, APythonFileLeadsANodeFromStateToState) {
  const auto path = sandbox_.directory() / "system.launch.py";
  write_file(path, R"py(
from launch import LaunchDescription
from launch.actions import EmitEvent, LogInfo, RegisterEventHandler, Shutdown, UnregisterEventHandler
from launch.events import matches_action
from launch_ros.actions import LifecycleNode
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition


def generate_launch_description():
    talker = LifecycleNode(package='lifecycle', executable='lifecycle_talker', name='talker', namespace='/left')

    def change(transition):
        return EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_action(talker), transition_id=transition))

    def tell(event, context):
        return LogInfo(msg=f'{event.action is talker}: {event.start_state} to {event.goal_state}')

    every = OnStateTransition(target_lifecycle_node=talker, entities=tell)
    return LaunchDescription([
        RegisterEventHandler(every),
        RegisterEventHandler(OnStateTransition(
            target_lifecycle_node=talker, goal_state='inactive',
            entities=[UnregisterEventHandler(every), change(Transition.TRANSITION_ACTIVATE)])),
        RegisterEventHandler(OnStateTransition(
            target_lifecycle_node=talker, start_state='activating', goal_state='active',
            entities=[LogInfo(msg='it is active'), Shutdown(reason='done')])),
        talker,
        change(Transition.TRANSITION_CONFIGURE),
    ])
)py");
  const CommandResult result = run_command({LAUNCH_PROGRAM, path.string()});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("True: unconfigured to configuring"));
  EXPECT_THAT(result.out, HasSubstr("True: configuring to inactive"));
  EXPECT_THAT(result.out, Not(HasSubstr("inactive to activating")));
  EXPECT_THAT(result.out, HasSubstr("it is active"));
}

// Matchers mean the action, so they find the node where its name and its namespace are gone.
TEST_F(LifecycleLaunch, APythonFileLeadsANodeWhoseScopeHasEnded) {
  const auto path = sandbox_.directory() / "system.launch.py";
  write_file(path, R"py(
from launch import LaunchDescription
from launch.actions import EmitEvent, GroupAction, LogInfo, RegisterEventHandler, SetLaunchConfiguration, Shutdown
from launch.events import matches_action
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import LifecycleNode, PushRosNamespace
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition


def generate_launch_description():
    talker = LifecycleNode(package='lifecycle', executable='lifecycle_talker', name=LaunchConfiguration('n'),
                           namespace='')

    def change(transition):
        return EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_action(talker), transition_id=transition))

    return LaunchDescription([
        GroupAction([
            PushRosNamespace('left'),
            SetLaunchConfiguration('n', 'talker'),
            talker,
            RegisterEventHandler(OnStateTransition(
                target_lifecycle_node=talker, goal_state='inactive', entities=[change(Transition.TRANSITION_ACTIVATE)])),
        ]),
        RegisterEventHandler(OnStateTransition(
            target_lifecycle_node=talker, goal_state='active',
            entities=lambda event, context: [LogInfo(msg='active: ' + event.action.node_name), Shutdown(reason='done')])),
        change(Transition.TRANSITION_CONFIGURE),
    ])
)py");
  const CommandResult result = run_command({LAUNCH_PROGRAM, path.string()});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("active: /left/talker"));
}

// As in ROS 2, an event comes after the traversal, and a handler may be there before its node.
TEST_F(LifecycleLaunch, APythonFileLeadsANodeThatComesAfterItsHandlers) {
  const auto path = sandbox_.directory() / "system.launch.py";
  write_file(path, R"py(
from launch import LaunchDescription, LaunchDescriptionSource
from launch.actions import (EmitEvent, GroupAction, IncludeLaunchDescription, LogInfo, RegisterEventHandler,
                            SetLaunchConfiguration, Shutdown)
from launch.conditions import IfCondition
from launch.events import matches_action
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import LifecycleNode
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition


def node(name, condition):
    return LifecycleNode(package='lifecycle', executable='lifecycle_talker', name=LaunchConfiguration(name),
                         namespace=LaunchConfiguration('space'), condition=IfCondition(condition))


def generate_launch_description():
    talker = node('n', 'true')
    never = node('nowhere', 'false')

    def change(node, transition):
        return EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_action(node), transition_id=transition))

    part = LaunchDescription([SetLaunchConfiguration('n', 'talker'), SetLaunchConfiguration('space', 'left'), talker])
    return LaunchDescription([
        RegisterEventHandler(OnStateTransition(
            target_lifecycle_node=never, goal_state='inactive', entities=[LogInfo(msg='never')])),
        RegisterEventHandler(OnStateTransition(
            target_lifecycle_node=talker, goal_state='inactive',
            entities=lambda event, context: [LogInfo(msg='inactive: ' + event.action.node_name), Shutdown()])),
        change(never, Transition.TRANSITION_CONFIGURE),
        change(talker, Transition.TRANSITION_CONFIGURE),
        GroupAction([IncludeLaunchDescription(LaunchDescriptionSource(part))]),
    ])
)py");
  const CommandResult result = run_command({LAUNCH_PROGRAM, path.string()});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("inactive: /left/talker"));
  EXPECT_THAT(result.out + result.err, HasSubstr("no state is changed, since the node of this event was not started"));
}

TEST_F(LifecycleLaunch, WhatNeverComesEndsTheLaunchAfterItsTime) {
  const std::string file =
      write(R"xml(<executable cmd="true"><depends_on service="/nobody/answers" timeout="0.5"/></executable>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("service '/nobody/answers' is offered"));
}

}  // namespace
