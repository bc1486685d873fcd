// SPDX-License-Identifier: Apache-2.0
// Scheduling, limits, environment and output of a process, and namespaces of groups and includes.
#include <gmock/gmock.h>
#include <sched.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/actions/launch_text.hpp"

namespace {

using launch::OutputTargets;
using launch::ProcessSpec;
using test_support::plan_actions;
using test_support::plan_text;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

ProcessSpec process_of(const std::string& text) {
  test_support::Planned planned = text.starts_with("launch:") ? plan_text(text) : plan_actions(text);
  EXPECT_EQ(planned.error, "");
  EXPECT_EQ(planned.plan.processes.size(), 1U);
  return planned.plan.processes.empty() ? ProcessSpec() : planned.plan.processes.front();
}

std::string error_of_executable(const std::string& attributes) {
  const std::string error = plan_actions("<executable cmd=\"a\" " + attributes + "/>").error;
  const std::size_t begin = error.find("error: ");
  const std::size_t end = error.find('\n', begin);
  const std::size_t help = error.find("= help: ", begin);
  return begin == std::string::npos ? error
                                    : error.substr(begin + 7, end - begin - 7) +
                                          (help == std::string::npos ? "" : "; " + error.substr(help + 8));
}

// The calls of read(2) that this process has made until now.
long number_of_reads() {
  std::ifstream file("/proc/self/io");
  std::string key;
  long number = -1;
  while (file >> key >> number && key != "syscr:") {
  }
  return number;
}

long reads_for(int executables) {
  std::string text;
  for (int i = 0; i < executables; ++i) {
    text += "<executable cmd=\"a\" name=\"a" + std::to_string(i) + "\"/>";
  }
  const long before = number_of_reads();
  EXPECT_EQ(plan_actions(text).error, "");
  return number_of_reads() - before;
}

TEST(ResourceFields, ReadNoFileForEachProcess) {
  if (number_of_reads() < 0) {
    GTEST_SKIP() << "skipped, because /proc/self/io cannot be read here";
  }
  (void)reads_for(1);  // what is read once
  EXPECT_EQ(reads_for(100), reads_for(1));
}

TEST(ResourceFields, AreTakenFromBothFormats) {
  const char* const xml = R"xml(<let name="cores" value="0,2-3"/>
    <executable cmd="a" nice="-5" sched_policy="fifo" sched_priority="80" cpus="$(var cores)" memory_limit="512M"
                open_files_limit="64"/>)xml";
  const char* const yaml = R"(launch:
- executable:
    cmd: a
    nice: -5
    sched_policy: fifo
    sched_priority: 80
    cpus: "3,2,0"
    memory_limit: 512M
    open_files_limit: 64
)";
  for (const char* const text : {xml, yaml}) {
    const launch::ResourceLimits limits = process_of(text).limits;
    EXPECT_EQ(limits.niceness, -5);
    EXPECT_EQ(limits.policy, SCHED_FIFO);
    EXPECT_EQ(limits.priority, 80);
    EXPECT_THAT(limits.cpus, ElementsAre(0, 2, 3));
    EXPECT_EQ(limits.memory, 512U * 1024 * 1024);
    EXPECT_EQ(limits.open_files, 64U);
    EXPECT_THAT(describe(limits),
                ElementsAre("nice -5", "policy fifo 80", "cpus 0,2-3", "memory 536870912 bytes", "64 open files"));
  }
}

TEST(ResourceFields, AreNothingByDefault) {
  EXPECT_FALSE(process_of(R"xml(<executable cmd="a"/>)xml").limits.any());
}

TEST(ResourceFields, SayWhatIsWrong) {
  EXPECT_EQ(error_of_executable("nice=\"20\""), "nice is a number from -20 to 19, got 20");
  EXPECT_EQ(error_of_executable("sched_policy=\"fif\" sched_priority=\"1\""),
            "'fif' is no scheduling policy, expected other, batch, idle, fifo, rr or deadline; did you mean 'fifo'?");
  EXPECT_EQ(error_of_executable("sched_policy=\"rr\""),
            "the policy rr needs a priority; add sched_priority, from 1 to 99");
  EXPECT_EQ(error_of_executable("sched_policy=\"rr\" sched_priority=\"0\""),
            "sched_priority is a number from 1 to 99, got 0");
  EXPECT_EQ(error_of_executable("sched_priority=\"7\""),
            "sched_priority goes with the policies fifo and rr only; add sched_policy=\"fifo\", or use nice");
  EXPECT_EQ(error_of_executable("cpus=\"2-1\""), "'2-1' is no list of CPUs; write numbers and ranges, such as 0,2-3");
  EXPECT_EQ(error_of_executable("cpus=\"\""), "'' is no list of CPUs; write numbers and ranges, such as 0,2-3");
  EXPECT_EQ(error_of_executable("cpus=\"0,1024\""),
            "'0,1024' is no list of CPUs; write numbers and ranges, such as 0,2-3");
  for (const char* const amount : {"much", "0", "-1", "1T", "99999999999999999999", "18446744073709551615G"}) {
    EXPECT_EQ(error_of_executable(std::string("memory_limit=\"") + amount + "\""),
              std::string("'") + amount + "' is no amount of memory; write bytes, or a number with K, M or G");
  }
  EXPECT_EQ(error_of_executable("open_files_limit=\"2\""), "open_files_limit is at least 3, got 2");
}

TEST(ResourceFields, OfRealTimeAreTaken) {
  const launch::ResourceLimits limits =
      process_of(R"xml(<executable cmd="a" sched_policy="deadline" sched_runtime="0.002" sched_deadline="0.01"
                    timer_slack="0.000001" locked_memory_limit="unlimited" oom_score_adj="-500"/>)xml")
          .limits;
  EXPECT_EQ(limits.policy, launch::kDeadlinePolicy);
  EXPECT_EQ(limits.schedule.runtime, std::chrono::milliseconds(2));
  EXPECT_EQ(limits.schedule.period, std::chrono::milliseconds(0)) << "as long as the deadline";
  EXPECT_THAT(describe(limits),
              ElementsAre("policy deadline", "0.002 s of a processor within 0.01 s in each 0.01 s",
                          "timer slack 1000 ns", "oom_score_adj -500", "any amount of locked memory"));
  EXPECT_THAT(launch_exec_arguments(limits), ElementsAre("o-500", "lunlimited", "s1000", "r2000000,10000000,0", "-"));
}

TEST(ResourceFields, OfRealTimeSayWhatIsWrong) {
  EXPECT_EQ(error_of_executable(R"(sched_policy="deadline")"),
            "the policy deadline needs a sched_runtime; add sched_runtime and sched_deadline, in seconds");
  EXPECT_EQ(error_of_executable(R"(sched_policy="deadline" sched_runtime="0.1" sched_deadline="0.01")"),
            "the deadline of 0.01 s is shorter than the runtime of 0.1 s");
  EXPECT_EQ(
      error_of_executable(R"(sched_policy="deadline" sched_runtime="0.01" sched_deadline="0.1" sched_period="0.05")"),
      "the period of 0.05 s is shorter than the deadline of 0.1 s; leave it out to have that of the deadline");
  EXPECT_EQ(error_of_executable(R"(sched_policy="deadline" sched_runtime="0.01" sched_deadline="0.1" cpus="0")"),
            "cpus does not go with the policy deadline; a thread with this policy runs on all CPUs of its cpuset; make "
            "a cpuset for it");
  EXPECT_EQ(error_of_executable(R"(sched_policy="deadline" sched_runtime="0" sched_deadline="0.1")"),
            "sched_runtime is at least 0.000001 s, got 0");
  EXPECT_EQ(error_of_executable(R"(sched_policy="deadline" sched_priority="3")"),
            "sched_priority goes with the policies fifo and rr only; add sched_policy=\"fifo\", or use nice");
  EXPECT_EQ(error_of_executable(R"(sched_period="0.1")"),
            "sched_period goes with the policy deadline only; add sched_policy=\"deadline\"");
  EXPECT_EQ(error_of_executable(R"(timer_slack="2")"), "timer_slack is a time from 0.000000001 to 1 second, got 2");
  EXPECT_EQ(error_of_executable(R"(oom_score_adj="2000")"), "oom_score_adj is a number from -1000 to 1000, got 2000");
}

TEST(ControlGroupFields, AreThoseOfTheProcessAndOfItsGroups) {
  const ProcessSpec spec = process_of(R"xml(
    <group memory_max="1G" cpu_quota="150%">
      <group pids_max="100">
        <executable cmd="a" memory_max="64M" memory_high="48M" cpu_weight="50" io_weight="20"/>
      </group>
    </group>)xml");
  EXPECT_THAT(describe(spec.control_limits),
              ElementsAre("memory_max 67108864 bytes", "memory_high 50331648 bytes", "cpu_weight 50", "io_weight 20"));
  ASSERT_EQ(spec.control_groups.size(), 2U);
  EXPECT_THAT(describe(spec.control_groups[0]->limits), ElementsAre("memory_max 1073741824 bytes", "cpu_quota 150%"));
  EXPECT_THAT(describe(spec.control_groups[1]->limits), ElementsAre("pids_max 100"));
  EXPECT_EQ(limits_of(spec).size(), 7U);
}

TEST(ControlGroupFields, OfAGroupEndWithIt) {
  EXPECT_THAT(process_of(R"xml(<group memory_max="1G"/><executable cmd="a"/>)xml").control_groups, IsEmpty());
}

TEST(ControlGroupFields, SayWhatIsWrong) {
  for (const char* const quota : {"50", "0%", "-1%", "half", "1e9%", "50%%"}) {
    EXPECT_EQ(error_of_executable(std::string("cpu_quota=\"") + quota + "\""),
              std::string("'") + quota +
                  "' is no share of a processor; write percents of one processor, from 1% on, such as 50% or 150%");
  }
  EXPECT_EQ(error_of_executable("memory_max=\"much\""),
            "'much' is no amount of memory; write bytes, or a number with K, M or G");
  EXPECT_EQ(error_of_executable("cpu_weight=\"0\""), "cpu_weight is a number from 1 to 10000, got 0");
  EXPECT_EQ(error_of_executable("pids_max=\"0\""), "pids_max is a number from 1 to 4194304, got 0");
  EXPECT_EQ(plan_actions(R"xml(<group memory_max="1G" scoped="false"/>)xml").error,
            "/test/system.launch.xml:2:2: error: limits need a scoped group: they are those of the processes in it\n"
            "    2 | <group memory_max=\"1G\" scoped=\"false\"/>\n"
            "      |  ^~~~~\n"
            "      = help: leave out scoped=\"false\"");
}

TEST(CleanEnvironment, HoldsOnlyWhatIsSaid) {
  const ProcessSpec spec = process_of(R"xml(<set_env name="A" value="1"/>
    <executable cmd="a" clean_env="true"><env name="B" value="$(env A)"/></executable>)xml");
  EXPECT_THAT(spec.environment, ElementsAre(Pair("B", "1")));
}

TEST(OutputTargets, MayBeSetForEachStream) {
  const ProcessSpec both = process_of(R"xml(<executable cmd="a" stdout="none" stderr="screen,own_log"/>)xml");
  EXPECT_EQ(both.output.out, OutputTargets());
  EXPECT_EQ(both.output.err, (OutputTargets{.screen = true, .own_log = true}));
  const ProcessSpec one = process_of(R"xml(<executable cmd="a" output="screen" stderr="log"/>)xml");
  EXPECT_EQ(one.output.out, OutputTargets{.screen = true});
  EXPECT_EQ(one.output.err, OutputTargets{.log = true});
}

TEST(OutputTargets, SayWhatIsWrong) {
  EXPECT_EQ(error_of_executable("stdout=\"scren\""),
            "'scren' is no place for output, expected screen, log, own_log or none; did you mean 'screen'?");
  EXPECT_EQ(error_of_executable("stderr=\"screen log\""),
            "'screen log' is no place for output, expected screen, log, own_log or none; write several with commas: "
            "screen,log");
}

TEST(OutputTargets, AreOverriddenByTheEnvironment) {
  test_support::PlanOptions options;
  options.environment["OVERRIDE_LAUNCH_PROCESS_OUTPUT"] = "screen";
  const auto planned = plan_actions(R"xml(<executable cmd="a" stdout="none"/>)xml", options);
  ASSERT_EQ(planned.plan.processes.size(), 1U);
  EXPECT_EQ(planned.plan.processes.front().output, *launch::OutputRouting::from_mode("screen"));
}

std::vector<std::string> namespaces(const test_support::Planned& planned) {
  EXPECT_EQ(planned.error, "");
  std::vector<std::string> result;
  for (const launch::NodeDescription& node : planned.plan.nodes) {
    result.push_back(node.name_space.value_or("none"));
  }
  return result;
}

TEST(GroupNamespace, IsBelowTheOuterOneAndEndsWithTheGroup) {
  EXPECT_THAT(namespaces(plan_actions(R"xml(
    <group ns="robot">
      <node exec="a"/>
      <group ns="left"><node exec="b"/></group>
      <group ns="/world"><node exec="c"/></group>
      <node exec="d" namespace="arm"/>
    </group>
    <node exec="e"/>)xml")),
              ElementsAre("/robot", "/robot/left", "/world", "/robot/arm", "none"));
  EXPECT_THAT(namespaces(plan_text("launch:\n- group:\n    ns: robot\n    children:\n    - node: {exec: a}\n")),
              ElementsAre("/robot"));
}

TEST(IncludeNamespace, EndsWithTheFileUnlikeWhatElseItSets) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("include_ns_" + std::to_string(::getpid()) + ".launch.xml");
  std::ofstream(file) << R"xml(<launch><push_ros_namespace namespace="inner"/><let name="x" value="y"/>
    <node exec="a"/></launch>)xml";
  const auto planned = plan_actions("<include ns=\"robot\" file=\"" + file.string() +
                                    "\"/><node exec=\"b\"/><log message=\"$(var x)\"/>");
  std::filesystem::remove(file);
  EXPECT_THAT(namespaces(planned), ElementsAre("/robot/inner", "none"));
  EXPECT_THAT(planned.messages, ElementsAre("[launch.user] y"));
}

TEST(ScopedInclude, KeepsWhatItSetsToItself) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("include_scoped_" + std::to_string(::getpid()) + ".launch.xml");
  std::ofstream(file) << R"xml(<launch><arg name="x" default="inside"/><let name="y" value="inside"/>
    <set_env name="Z" value="inside"/><push_ros_namespace namespace="left"/><set_parameter name="p" value="1"/>
    <node exec="a"/><log message="$(var x) $(var y) $(env Z)"/></launch>)xml";
  const auto planned =
      plan_actions("<let name=\"y\" value=\"outside\"/><include scoped=\"true\" file=\"" + file.string() +
                   "\"><arg name=\"x\" value=\"given\"/></include><node exec=\"b\"/>"
                   "<log message=\"$(var x none) $(var y) $(env Z none) $(param p none)\"/>");
  std::filesystem::remove(file);
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(namespaces(planned), ElementsAre("/left", "none"));
  EXPECT_THAT(planned.messages,
              ElementsAre("[launch.user] given inside inside", "[launch.user] none outside none none"));
}

TEST(GroupNamespace, NeedsAScope) {
  EXPECT_EQ(plan_actions(R"xml(<group ns="a" scoped="false"/>)xml").error,
            "/test/system.launch.xml:2:12: error: ns needs a scoped group: it ends with the group\n"
            "    2 | <group ns=\"a\" scoped=\"false\"/>\n"
            "      |            ^\n"
            "      = help: use push_ros_namespace for a namespace that stays");
}

}  // namespace
