// SPDX-License-Identifier: Apache-2.0
// Features that only Python launch files have.
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/python/python_plan.hpp"
#include "tracing/record/plan/ros_events.hpp"

namespace {

using test_support::plan_items;
using test_support::plan_python;
using test_support::PythonPlan;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(PythonLaunchFile, AFunctionSeesAndChangesTheStateOfTheLaunch) {
  const PythonPlan planned = plan_python(R"py(
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo, OpaqueFunction
from launch.substitutions import LaunchConfiguration


def setup(context, word, times=1):
    count = int(LaunchConfiguration('count').perform(context))
    context.launch_configurations['sum'] = str(count + 1)
    context.environment['MADE'] = context.perform_substitution(LaunchConfiguration('count'))
    return [LogInfo(msg=f'{word} {i}') for i in range(count * times)] + [LogInfo(msg=LaunchConfiguration('sum'))]


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('count', default_value='1'),
        OpaqueFunction(function=setup, args=['turn'], kwargs={'times': 2}),
        LogInfo(msg=['after ', LaunchConfiguration('sum')]),
    ])
)py");
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.logs, ElementsAre("turn 0", "turn 1", "2", "after 2"));
  EXPECT_EQ(planned.environment.at("MADE"), "1");
}

TEST(PythonLaunchFile, ArgumentsOfTheCommandLineReachIt) {
  const PythonPlan planned = plan_items(
      "        DeclareLaunchArgument('mode', default_value='sim'), LogInfo(msg=LaunchConfiguration('mode')),",
      {.arguments = {{"mode", "robot"}}});
  EXPECT_THAT(planned.plan.logs, ElementsAre("robot"));
}

TEST(PythonLaunchFile, ConditionsOfEveryKindHoldOrNot) {
  const PythonPlan planned = plan_items(R"py(
        SetLaunchConfiguration('x', 'a'),
        LogInfo(msg='if', condition=IfCondition(EqualsSubstitution(LaunchConfiguration('x'), 'a'))),
        LogInfo(msg='never', condition=UnlessCondition('1')),
        LogInfo(msg='equals', condition=LaunchConfigurationEquals('x', 'a')),
        LogInfo(msg='never', condition=LaunchConfigurationEquals('x', 'b')),
        LogInfo(msg='not equals', condition=LaunchConfigurationNotEquals('x', 'b')),
        LogInfo(msg='unset', condition=LaunchConfigurationEquals('y', None)),
        LogInfo(msg='predicate', condition=Condition(predicate=lambda context: 'x' in context.launch_configurations)),
        OpaqueFunction(function=lambda context: [LogInfo(msg='never')], condition=IfCondition('false')),)py");
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.logs, ElementsAre("if", "equals", "not equals", "unset", "predicate"));
}

TEST(PythonLaunchFile, SubstitutionsAndActionsOfItsOwnWork) {
  const PythonPlan planned = plan_python(R"py(
import launch
from launch.actions import LogInfo
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions


class Upper(launch.Substitution):

    def __init__(self, source):
        super().__init__()
        self.source = normalize_to_list_of_substitutions(source)

    def perform(self, context):
        return perform_substitutions(context, self.source).upper()


class Twice(launch.Action):

    def __init__(self, text, **kwargs):
        super().__init__(**kwargs)
        self.text = text

    def execute(self, context):
        return [LogInfo(msg=self.text), LogInfo(msg=self.text)]


class Loud(LogInfo):

    def execute(self, context):
        return [LogInfo(msg='!'), *super().execute(context)]


def generate_launch_description():
    return launch.LaunchDescription([
        launch.actions.SetLaunchConfiguration('x', 'word'),
        Twice(['a ', Upper(['b ', launch.substitutions.LaunchConfiguration('x')])]),
        Loud(msg='loud', condition=launch.conditions.IfCondition('true')),
    ])
)py");
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.logs, ElementsAre("a B WORD", "a B WORD", "!", "loud"));
}

TEST(PythonLaunchFile, ItsEnvironmentIsThatOfTheLaunch) {
  const PythonPlan planned =
      plan_python(R"py(
import os
from launch import LaunchDescription
from launch.actions import ExecuteProcess, OpaqueFunction, SetEnvironmentVariable, UnsetEnvironmentVariable


def check(context):
    return [ExecuteProcess(cmd=['second', os.environ['A'], str('B' in os.environ), os.getenv('C', 'none')])]


def generate_launch_description():
    os.environ['AT_LOAD'] = os.environ['GIVEN'] + '!'
    del os.environ['REMOVED']
    return LaunchDescription([
        ExecuteProcess(cmd=['first']), SetEnvironmentVariable('A', '1'), UnsetEnvironmentVariable('C'),
        OpaqueFunction(function=check)])
)py",
                  {.environment = {{"GIVEN", "x"}, {"REMOVED", "y"}, {"C", "z"}, {"PATH", "/bin"}}});
  EXPECT_EQ(planned.error, "");
  EXPECT_EQ(planned.plan.processes.at(0).environment,
            (launch::Environment{{"AT_LOAD", "x!"}, {"C", "z"}, {"GIVEN", "x"}, {"PATH", "/bin"}}));
  EXPECT_THAT(planned.plan.processes.at(1).argv, ElementsAre("second", "1", "False", "none"));
}

TEST(PythonLaunchFile, PushedStateIsPopped) {
  const PythonPlan planned = plan_items(R"py(
        SetLaunchConfiguration('x', '1'), SetEnvironmentVariable('E', '1'),
        PushLaunchConfigurations(), PushEnvironment(),
        SetLaunchConfiguration('x', '2'), SetEnvironmentVariable('E', '2'),
        LogInfo(msg=[LaunchConfiguration('x'), EnvironmentVariable('E')]),
        PopEnvironment(), LogInfo(msg=[LaunchConfiguration('x'), EnvironmentVariable('E')]),
        PopLaunchConfigurations(), LogInfo(msg=[LaunchConfiguration('x'), EnvironmentVariable('E')]),)py");
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.logs, ElementsAre("22", "21", "11"));
}

TEST(PythonLaunchFile, AMappingOfParametersIsOneFile) {
  const PythonPlan planned = plan_items(R"py(
        SetLaunchConfiguration('n', '5'),
        Node(executable='/bin/node', name='n', namespace='/', parameters=[
            {'a': LaunchConfiguration('n'), 'b': '5', 'c': ['x', 'y'], 'd': [1, 2.5], 'e': {'f': True},
             'g': [LaunchConfiguration('n'), 'px'], 'h': [[LaunchConfiguration('n')], ['6']],
             ('i', LaunchConfiguration('n')): 1}]),)py");
  EXPECT_EQ(planned.error, "");
  ASSERT_EQ(planned.plan.processes.at(0).files.size(), 1U);
  EXPECT_EQ(planned.plan.processes.at(0).files[0].content,
            "/n:\n  ros__parameters:\n    a: 5\n    b: \"5\"\n    c: [\"x\", \"y\"]\n    d: [1.0, 2.5]\n    e.f: true\n"
            "    g: \"5px\"\n    h: [5, 6]\n    i5: 1\n");
}

TEST(PythonLaunchFile, AComposableNodeNeedsNoName) {
  const PythonPlan planned = plan_items(R"py(
        LoadComposableNodes(target_container='c', composable_node_descriptions=[
            ComposableNode(package='p', plugin='P')]),)py");
  EXPECT_EQ(planned.error, "");
  EXPECT_EQ(planned.plan.loads.at(0).nodes.at(0).name, "");
}

TEST(PythonLaunchFile, IsRunOnceForEachInclude) {
  const std::string path = testing::TempDir() + "counted.launch.py";
  std::ofstream(path) << R"py(
import os
from launch import LaunchDescription
from launch.actions import LogInfo


def generate_launch_description():
    with open(__file__ + '.count', 'a') as file:
        file.write('.')
    return LaunchDescription([LogInfo(msg='here')])
)py";
  const PythonPlan planned = plan_items("        IncludeLaunchDescription('" + path + "'),\n        " +
                                        "GroupAction([IncludeLaunchDescription('" + path + "')]),");
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.logs, ElementsAre("here", "here"));
  EXPECT_EQ(std::filesystem::file_size(path + ".count"), 2U);
  std::filesystem::remove(path);
  std::filesystem::remove(path + ".count");
}

TEST(PythonLaunchFile, MessagesOfItsLoggersAreTheLaunchers) {
  const PythonPlan planned = plan_items(R"py(
        OpaqueFunction(function=lambda context: launch.logging.get_logger('mine').warning('look')),)py");
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(planned.messages, ElementsAre("[mine] look"));
}

TEST(PythonLaunchFile, NamesOfEventsAreThoseThatASessionRecords) {
  const PythonPlan planned = plan_python(R"py(
from launch import LaunchDescription
from launch.actions import LogInfo
from tracetools_trace.tools import names, tracepoints


def generate_launch_description():
    constants = [value for name, value in vars(tracepoints).items() if value == 'ros2:' + name]
    return LaunchDescription([LogInfo(msg=' '.join(events)) for events in (
        names.DEFAULT_EVENTS_ROS, names.DEFAULT_EVENTS_UST, constants, names.DEFAULT_INIT_EVENTS_ROS)])
)py");
  EXPECT_EQ(planned.error, "");
  const std::string all = fmt::format("{}", fmt::join(tracing::default_ros_events(), " "));
  const std::string initialisation = fmt::format("{}", fmt::join(tracing::initialisation_ros_events(), " "));
  EXPECT_THAT(planned.plan.logs, ElementsAre(all, all, all, initialisation));
}

TEST(PythonLaunchFile, PlacesOfItsActionsAreInIt) {
  const PythonPlan planned = plan_items("        ExecuteProcess(\n            cmd=['true']),");
  ASSERT_EQ(planned.error, "");
  EXPECT_EQ(launch::to_string(planned.plan.processes.at(0).origin), "/test/system.launch.py:14:9");
}

}  // namespace
