// SPDX-License-Identifier: Apache-2.0
// A plan calls the functions that make a description, and none that waits for an event or a timer.
#include "tests/unit/python/python_plan.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "launcher/plan/dry_run.hpp"

namespace {

using test_support::plan_python;
using test_support::PythonPlan;
using testing::ElementsAre;
using testing::HasSubstr;

// A launch file whose functions remove the file that `kept` names. `items` are those of the launch description.
std::string file_with(const std::string& items, const std::string& kept) {
  return R"py(
import os
from launch import *
from launch.actions import *
from launch.conditions import *
from launch.event_handlers import *
from launch.substitutions import *
from launch_ros.actions import *


def clean_up(*_args):
    os.remove(')py" +
         kept + R"py(')
    return [LogInfo(msg='removed')]


class Remove(Action):

    def execute(self, context):
        return clean_up()


def generate_launch_description():
    program = ExecuteProcess(cmd=['true'])
    return LaunchDescription([program,
        )py" +
         items + "])\n";
}

class APlan : public testing::TestWithParam<const char*> {};

TEST_P(APlan, CallsNoFunctionThatWaitsForAnEvent) {
  const std::string kept = testing::TempDir() + "python_plan_test_" + std::to_string(::getpid());
  std::ofstream(kept).put('\n');
  const PythonPlan planned = plan_python(file_with(GetParam(), kept));
  EXPECT_EQ(planned.error, "");
  EXPECT_TRUE(std::filesystem::exists(kept));
  std::filesystem::remove(kept);
  EXPECT_THAT(launch::plan_as_text(planned.plan, planned.environment),
              HasSubstr("depends on a function that only a run calls"));
  EXPECT_THAT(launch::plan_as_json(planned.plan, planned.environment), HasSubstr("\"only_in_a_run\""));
}

INSTANTIATE_TEST_SUITE_P(
    All, APlan,
    testing::Values(
        "RegisterEventHandler(OnShutdown(on_shutdown=clean_up))",
        "RegisterEventHandler(OnShutdown(on_shutdown=lambda event, context: clean_up()))",
        "RegisterEventHandler(OnShutdown(on_shutdown=[OpaqueFunction(function=clean_up)]))",
        "RegisterEventHandler(OnProcessExit(target_action=program, on_exit=clean_up))",
        "RegisterEventHandler(OnProcessExit(on_exit=[GroupAction([OpaqueFunction(function=clean_up)])]))",
        "RegisterEventHandler(OnProcessStart(target_action=program, on_start=[Remove()]))",
        "RegisterEventHandler(OnProcessIO(on_stdout=clean_up))",
        "RegisterEventHandler(OnExecutionComplete(target_action=program, on_completion=clean_up))",
        "RegisterEventHandler(OnShutdown(on_shutdown=[LogInfo(msg='', condition=Condition(predicate=clean_up))]))",
        "RegisterEventHandler(OnShutdown(on_shutdown=[ForLoop(3, function=clean_up)]))",
        "ExecuteProcess(cmd=['true'], on_exit=[OpaqueFunction(function=clean_up)])",
        "ExecuteProcess(cmd=['true'], on_exit=clean_up)",
        "TimerAction(period=1.0, actions=[OpaqueFunction(function=clean_up)])",
        "TimerAction(period=1.0, actions=[Remove()])",
        "TimerAction(period=1.0, actions=[RegisterEventHandler(OnShutdown(on_shutdown=clean_up))])",
        "OpaqueFunction(function=lambda context: [RegisterEventHandler(OnShutdown(on_shutdown=clean_up))])"));

TEST(APythonPlan, CallsWhatMakesTheDescription) {
  const PythonPlan planned = plan_python(
      file_with("OpaqueFunction(function=lambda context: [LogInfo(msg='made')]), LogInfo(msg='', condition=Condition("
                "predicate=lambda context: False)),",
                "/"));
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.logs, ElementsAre("made"));
  EXPECT_TRUE(planned.plan.left_to_run.empty());
}

TEST(APythonPlan, GoesOnAfterAFunctionThatIsLeftToARun) {
  const PythonPlan planned =
      plan_python(file_with("RegisterEventHandler(OnProcessExit(on_exit=[OpaqueFunction(function=clean_up), "
                            "LogInfo(msg=LaunchConfiguration('set_by_clean_up')), ExecuteProcess(cmd=['after'])])),",
                            "/"));
  EXPECT_EQ(planned.error, "");
  const launch::LaunchPlan& handler = planned.plan.reactions.at(0);
  ASSERT_EQ(handler.left_to_run.size(), 2U);
  EXPECT_EQ(handler.left_to_run[0].function, "clean_up");
  EXPECT_THAT(handler.left_to_run[1].error, HasSubstr("'set_by_clean_up' does not exist"));
  EXPECT_EQ(handler.processes.at(0).argv.at(0), "after");
}

TEST(APythonPlan, KeepsTheErrorsOfHandlersThatCallNoFunction) {
  const PythonPlan planned = plan_python(
      file_with("RegisterEventHandler(OnShutdown(on_shutdown=[LogInfo(msg=LaunchConfiguration('missing'))])),", "/"));
  EXPECT_THAT(planned.error, HasSubstr("'missing' does not exist"));
}

TEST(APythonPlan, EndsWhenAnActionGivesItself) {
  const PythonPlan planned = plan_python(R"py(
from launch import Action, LaunchDescription


class Itself(Action):

    def execute(self, context):
        return [self]


def generate_launch_description():
    return LaunchDescription([Itself()])
)py");
  EXPECT_THAT(planned.error, HasSubstr("actions hold each other more than"));
}

}  // namespace
