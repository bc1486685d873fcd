// SPDX-License-Identifier: Apache-2.0
// <trace>: the values of its attributes. It takes effect for every process of the file.
#include <gmock/gmock.h>

#include "tests/unit/actions/launch_text.hpp"
#include "tracing/record/plan/preload.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace {

using test_support::plan_actions;
using test_support::plan_text;
using test_support::Planned;
using testing::ElementsAre;
using testing::HasSubstr;

std::map<std::string, launch::ShownSetting> settings_of(const Planned& planned) {
  std::map<std::string, launch::ShownSetting> settings;
  EXPECT_EQ(planned.error, "");
  for (const launch::ShownSetting& setting : planned.plan.scopes.at(0)->describe()) {
    settings.emplace(setting.name, setting);
  }
  return settings;
}

using Words = std::vector<std::string>;

TEST(Trace, DefaultsAreThoseOfRos2TracingButForTheBuffers) {
  const Planned planned = plan_actions(R"xml(<trace session-name="run"/>)xml");
  auto settings = settings_of(planned);
  EXPECT_EQ(std::get<std::string>(settings.at("session-name").value), "run");
  EXPECT_EQ(std::get<std::string>(settings.at("trace-directory").value), "/home/user/.ros/tracing/run");
  EXPECT_EQ(std::get<Words>(settings.at("events-ust").value).size(), 42U);
  EXPECT_TRUE(std::get<Words>(settings.at("events-kernel").value).empty());
  EXPECT_TRUE(std::get<Words>(settings.at("syscalls").value).empty());
  EXPECT_THAT(std::get<Words>(settings.at("context-fields").value), ElementsAre("procname", "vpid", "vtid"));
  EXPECT_EQ(std::get<std::int64_t>(settings.at("subbuffer-size-ust").value),
            static_cast<std::int64_t>(tracing::TraceConfig().ust.subbuffer_size));
  EXPECT_EQ(std::get<std::int64_t>(settings.at("subbuffer-size-kernel").value), 131072);
  EXPECT_FALSE(std::get<bool>(settings.at("append-trace").value));
  EXPECT_FALSE(std::get<bool>(settings.at("fail-on-loss").value));
  EXPECT_FALSE(std::get<bool>(settings.at("snapshot-mode").value));
  EXPECT_FALSE(std::get<bool>(settings.at("dual-session").value));
}

TEST(Trace, ListsAreSplitLikeCommandLines) {
  auto settings = settings_of(plan_actions(R"xml(
    <let name="kernel" value=""/><let name="more" value="a if b"/>
    <trace session-name="run" events-ust="ros2:* 'x if y' $(var more)" events-kernel="$(var kernel)" context-fields=""/>)xml"));
  EXPECT_THAT(std::get<Words>(settings.at("events-ust").value), ElementsAre("ros2:*", "x if y", "a if b"));
  EXPECT_TRUE(std::get<Words>(settings.at("events-kernel").value).empty());
  EXPECT_TRUE(std::get<Words>(settings.at("context-fields").value).empty());
}

TEST(Trace, TheLimitOfItsCostIsAPercentageOfAProcessor) {
  auto settings = settings_of(plan_actions(R"xml(<trace session-name="run" max-overhead="2.5%"/>)xml"));
  EXPECT_EQ(std::get<std::string>(settings.at("max-overhead").value), "2.5%");
  EXPECT_THAT(std::get<Words>(settings.at("drop-order").value),
              ElementsAre("executor", "buffers", "layers", "messages", "services", "callbacks"));
  auto ordered = settings_of(plan_actions(
      R"xml(<trace session-name="run" max-overhead="2%" drop-order="callbacks ros2:rmw_* my_app:*"/>)xml"));
  EXPECT_THAT(std::get<Words>(ordered.at("drop-order").value), ElementsAre("callbacks", "ros2:rmw_*", "my_app:*"));
  auto unlimited = settings_of(plan_actions(R"xml(<trace session-name="run"/>)xml"));
  EXPECT_EQ(std::get<std::string>(unlimited.at("max-overhead").value), "");
  EXPECT_TRUE(std::get<Words>(unlimited.at("drop-order").value).empty());
}

TEST(Trace, OfAnotherMachineIsPlannedWithoutAConnection) {
  const auto planned = plan_actions(R"xml(<machine name="arm" connect="ssh arm"/>
    <trace session-name="all"/>
    <trace session-name="one" machine="arm"/>
    <executable cmd="a" machine="arm"/>)xml");
  EXPECT_EQ(planned.error, "");
  EXPECT_EQ(planned.plan.scopes.size(), 2u);
}

TEST(Trace, DeadlinesMakeItAFlightRecorderThatWatchesForThem) {
  const Planned planned = plan_actions(R"xml(
    <trace session-name="run" snapshot-on-late-callback="0.5" snapshot-on-late-message="20"/>
    <executable cmd="true"/>)xml");
  auto settings = settings_of(planned);
  EXPECT_TRUE(std::get<bool>(settings.at("snapshot-mode").value));
  const auto& environment = planned.plan.processes.at(0).environment;
  EXPECT_EQ(environment.at("TRACETOOLS_CALLBACK_DEADLINE"), "500000");
  EXPECT_EQ(environment.at("TRACETOOLS_MESSAGE_DEADLINE"), "20000000");
}

TEST(Trace, DualSessionAsASubstitutionSelectsItsEventsWhenVisited) {
  const std::string xml = R"xml(<trace session-name="run" dual-session="$(var dual)"/>)xml";
  auto dual = settings_of(plan_actions(xml, {.arguments = {{"dual", "true"}}}));
  EXPECT_EQ(std::get<Words>(dual.at("events-ust").value).size(), 22U);
  EXPECT_EQ(std::get<std::string>(dual.at("trace-directory").value), "/home/user/.ros/tracing/run/snapshot");
  auto single = settings_of(plan_actions(xml, {.arguments = {{"dual", "false"}}}));
  EXPECT_EQ(std::get<Words>(single.at("events-ust").value).size(), 42U);
}

TEST(Trace, DirectoriesComeFromTheLaunchEnvironment) {
  const std::string xml = R"xml(<trace session-name="run"/>)xml";
  auto by_home = settings_of(plan_actions(xml, {.environment = {{"HOME", "/h"}, {"ROS_HOME", "/ros"}}}));
  EXPECT_EQ(std::get<std::string>(by_home.at("trace-directory").value), "/ros/tracing/run");
  auto by_variable = settings_of(plan_actions(xml, {.environment = {{"HOME", "/h"}, {"ROS_TRACE_DIR", "/traces"}}}));
  EXPECT_EQ(std::get<std::string>(by_variable.at("trace-directory").value), "/traces/run");
  auto given = settings_of(plan_actions(R"xml(<trace session-name="run" base-path="/elsewhere"/>)xml"));
  EXPECT_EQ(std::get<std::string>(given.at("trace-directory").value), "/elsewhere/run");
}

// Where no tracepoints are built, LTTng-UST may be missing.
#define NEEDS_LTTNG_UST()                                                                  \
  if (!HAS_TRACEPOINTS && tracing::plan_preload({"lttng_ust_libc:*"}).libraries.empty()) { \
    GTEST_SKIP() << "skipped, because LTTng-UST is not installed (liblttng-ust1)";         \
  }                                                                                        \
  static_assert(true)

TEST(Trace, PreloadsForProcessesBeforeItToo) {
  NEEDS_LTTNG_UST();
  const Planned planned = plan_actions(R"xml(
    <executable cmd="first"/>
    <trace session-name="run" events-ust="lttng_ust_libc:*"/>
    <executable cmd="second"><env name="LD_PRELOAD" value="mine.so"/></executable>)xml");
  ASSERT_EQ(planned.error, "");
  const std::string first = planned.plan.processes.at(0).environment.at("LD_PRELOAD");
  EXPECT_THAT(first, testing::MatchesRegex(".*/liblttng-ust-libc-wrapper.so:.*/liblttng-ust-fork.so"));
  EXPECT_EQ(planned.plan.processes.at(1).environment.at("LD_PRELOAD"), "mine.so:" + first);
}

TEST(Trace, ASubstitutionMayGiveSeveralNames) {
  auto settings = settings_of(plan_actions(R"xml(
    <let name="events" value="ros2:*callback* ros2:rcl_*_init"/><let name="fields" value="vpid vtid"/>
    <let name="kernel" value="sched_switch irq_handler_entry"/>
    <trace session-name="run" events-ust="$(var events) a:b" events-kernel="$(var kernel)"
           context-fields="$(var fields)"/>)xml"));
  EXPECT_THAT(std::get<Words>(settings.at("events-kernel").value), ElementsAre("sched_switch", "irq_handler_entry"));
  EXPECT_THAT(std::get<Words>(settings.at("events-ust").value),
              ElementsAre("ros2:*callback*", "ros2:rcl_*_init", "a:b"));
  EXPECT_THAT(std::get<Words>(settings.at("context-fields").value), ElementsAre("vpid", "vtid"));
  EXPECT_THAT(std::get<Words>(settings.at("context-fields-kernel").value), ElementsAre("vpid", "vtid"));
}

TEST(Trace, YamlTakesListsOfTextsAndListsOfChannels) {
  auto settings = settings_of(plan_text(R"yaml(launch:
- let: {name: what, value: "ros2:rmw_*"}
- trace:
    session-name: run
    events-ust: ["$(var what)", "my:event if a == 1"]
    context-fields: [vpid]
    context-fields-kernel: [pid, tid]
    channel:
    - {name: fast, events-ust: ["ros2:callback_*"], subbuffer-size: 8192}
    - {name: slow, events-ust: "a:b c:d"}
)yaml"));
  EXPECT_THAT(std::get<Words>(settings.at("events-ust").value), ElementsAre("ros2:rmw_*", "my:event if a == 1"));
  EXPECT_THAT(std::get<Words>(settings.at("context-fields").value), ElementsAre("vpid"));
  EXPECT_THAT(std::get<Words>(settings.at("context-fields-kernel").value), ElementsAre("pid", "tid"));
  EXPECT_THAT(std::get<Words>(settings.at("channels").value), ElementsAre("fast", "slow"));
}

TEST(Trace, ListsInYamlHoldTexts) {
  EXPECT_THAT(plan_text("launch:\n- trace: {session-name: run, syscalls: [openat, 5]}\n").error,
              HasSubstr("error: the list 'syscalls' of 'trace' is expected to hold texts, got int"));
}

TEST(Trace, ChannelsStandInXmlAsElements) {
  auto settings = settings_of(plan_actions(R"xml(<trace session-name="run">
    <channel name="fast" events-ust="ros2:callback_*" subbuffer-size="8192" blocking-timeout="-1"/></trace>)xml"));
  EXPECT_THAT(std::get<Words>(settings.at("channels").value), ElementsAre("fast"));
}

TEST(Trace, MalformedEventsAreErrorsAtTheirPlaceBeforeAnythingStarts) {
  EXPECT_THAT(plan_actions(R"xml(<trace session-name="run" events-ust="'a:b level LOUD'"/>)xml").error,
              HasSubstr(":2:39: error: unknown log level 'LOUD' in event 'a:b level LOUD'"));
  EXPECT_THAT(plan_actions(R"xml(<trace session-name="run" buffers-ust="gid"/>)xml").error,
              HasSubstr(":2:40: error: buffers-ust is expected to be uid or pid, got 'gid'"));
  EXPECT_THAT(plan_actions(R"xml(<trace session-name="run" tracetools="their"/>)xml").error,
              HasSubstr(":2:39: error: tracetools is expected to be auto or own or theirs, got 'their'"));
  EXPECT_THAT(plan_actions(R"xml(<trace session-name="run" snapshot-limit="0"/>)xml").error,
              HasSubstr(":2:43: error: snapshot-limit is at least 1, got 0"));
}

std::string preload_of(const launch::ProcessSpec& spec) {
  const auto found = spec.environment.find("LD_PRELOAD");
  return found == spec.environment.end() ? "" : found->second;
}

TEST(Trace, ProcessesThatAreNotToBeTracedArePreloadedWithWhatKeepsThemOut) {
  NEEDS_LTTNG_UST();
  const Planned planned = plan_actions(R"xml(
    <trace session-name="run" events-ust="lttng_ust_libc:*"/>
    <executable cmd="first" trace="false"/>
    <executable cmd="second"/>)xml");
  ASSERT_EQ(planned.error, "");
  EXPECT_THAT(preload_of(planned.plan.processes.at(0)), testing::EndsWith("lib/launch/liblaunch_untraced.so"));
  EXPECT_EQ(planned.plan.processes.at(0).environment.at("LTTNG_UST_REGISTER_TIMEOUT"), "0");
  EXPECT_THAT(preload_of(planned.plan.processes.at(1)),
              testing::MatchesRegex(".*/liblttng-ust-libc-wrapper.so:.*/liblttng-ust-fork.so"));
}

TEST(Trace, NodesNamesThoseThatAloneAreTraced) {
  const Planned planned = plan_actions(R"xml(
    <trace session-name="run" nodes="talk* chatter"/>
    <executable cmd="talker"/><executable cmd="listener"/><executable cmd="mute" trace="false"/>)xml");
  ASSERT_EQ(planned.error, "");
  EXPECT_EQ(preload_of(planned.plan.processes.at(0)), "");
  EXPECT_NE(preload_of(planned.plan.processes.at(1)), "");
  EXPECT_NE(preload_of(planned.plan.processes.at(2)), "");
}

TEST(Trace, PreloadsForTheEventsOfItsChannels) {
  NEEDS_LTTNG_UST();
  const Planned planned = plan_actions(R"xml(
    <trace session-name="run"><channel name="memory" events-ust="lttng_ust_libc:malloc"/></trace>
    <executable cmd="talker"/>)xml");
  ASSERT_EQ(planned.error, "");
  EXPECT_THAT(preload_of(planned.plan.processes.at(0)), HasSubstr("/liblttng-ust-libc-wrapper.so"));
}

TEST(Trace, LttngCollectsLoadAddressesOnlyWhereATraceRecordsThem) {
  const auto collects = [](const std::string& traces) {
    const Planned planned = plan_actions(traces + R"xml(<executable cmd="talker"/>)xml");
    EXPECT_EQ(planned.error, "");
    return !planned.plan.processes.at(0).environment.contains("LTTNG_UST_WITHOUT_BADDR_STATEDUMP");
  };
  const std::string without = R"xml(<trace session-name="plain"/>)xml";
  const std::string with = R"xml(<trace session-name="addresses" events-ust="lttng_ust_statedump:*"/>)xml";
  EXPECT_TRUE(collects(""));
  EXPECT_FALSE(collects(without));
  EXPECT_TRUE(collects(with));
  EXPECT_TRUE(collects(with + without));
  EXPECT_TRUE(collects(without + with));
  EXPECT_TRUE(
      collects(R"xml(<trace session-name="run"><channel name="lib" events-ust="lttng_ust_lib:load"/></trace>)xml"));
}

TEST(Trace, BlockingIsPermittedToProcesses) {
  const Planned planned = plan_actions(R"xml(
    <trace session-name="run" blocking-timeout-ust="100"/><executable cmd="talker"/>)xml");
  EXPECT_EQ(planned.plan.processes.at(0).environment.at("LTTNG_UST_ALLOW_BLOCKING"), "1");
}

TEST(Trace, ConditionsApply) {
  EXPECT_TRUE(plan_actions(R"xml(<trace session-name="run" if="false"/>)xml").plan.scopes.empty());
}

TEST(Trace, BadNamesAreErrorsAtTheirPlace) {
  EXPECT_THAT(plan_actions(R"xml(<trace session-name=""/>)xml").error,
              HasSubstr(":2:22: error: the session name is empty"));
  EXPECT_THAT(plan_actions(R"xml(<trace session-name="a/b"/>)xml").error,
              HasSubstr("the session name 'a/b' has a slash"));
  EXPECT_THAT(plan_actions(R"xml(<trace/>)xml").error,
              HasSubstr("attribute 'session-name' not found in entity 'trace'"));
  EXPECT_THAT(plan_actions(R"xml(<trace session-name="a" event-ust="x"/>)xml").error,
              HasSubstr("did you mean 'events-ust'?"));
}

}  // namespace
