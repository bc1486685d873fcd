// SPDX-License-Identifier: Apache-2.0
// Processes and events that a recording should have had.
#include "tracing/record/account/absence.hpp"

#include <gmock/gmock.h>

#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/loss_text.hpp"
#include "tracing/record/account/stream_packets.hpp"
#include "tracing/record/account/verdict.hpp"

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tracing::absent_events;
using tracing::absent_processes;
using tracing::EventCounts;
using tracing::RecordedEvents;

constexpr std::uint64_t kOneSecond = 1'000'000'000;

RecordedEvents rules(const std::vector<std::string>& patterns) {
  RecordedEvents events;
  for (const std::string& pattern : patterns) {
    events.rules.push_back({.channel = "ros2", .pattern = pattern});
  }
  return events;
}

std::vector<std::string> texts(const std::vector<tracing::Absence>& absences) {
  std::vector<std::string> texts;
  for (const tracing::Absence& absence : absences) {
    texts.push_back(absence.text);
  }
  return texts;
}

const std::vector<EventCounts> kProcesses = {
    {.pid = 11, .process = "early", .begin = kOneSecond, .reached = kOneSecond, .events = {{"ros2:rcl_take", 5}}},
    {.pid = 12, .process = "late", .begin = kOneSecond, .reached = 24 * kOneSecond, .missed = 812},
    {.pid = 13, .process = "never", .begin = kOneSecond, .missed = 1},
    {.pid = 14, .process = "silent", .begin = kOneSecond}};

TEST(Absence, OfProcessesIsToldWithWhatTheyFiredMeanwhile) {
  EXPECT_THAT(texts(absent_processes(kProcesses)),
              ElementsAre("late [12] is recorded from 23.0 s after its start on: 812 events that it fired before are "
                          "missing",
                          "never [13] was never registered with the session daemon: 1 event that it fired is missing"));
}

TEST(Absence, OfManyProcessesIsSummedUp) {
  std::vector<EventCounts> many;
  for (int i = 0; i < 8; ++i) {
    many.push_back({.pid = i, .process = "node", .missed = 10});
  }
  const std::vector<std::string> told = texts(absent_processes(many));
  ASSERT_EQ(told.size(), 6u);
  EXPECT_EQ(told.back(), "3 processes more recorded late or never: 30 events missing");
}

TEST(Absence, OfEventsIsToldForRulesThatNoProgramKnows) {
  EXPECT_THAT(texts(absent_events(rules({"ros2:rcl_inti", "ros2:rcl_*", "my_app:*"}), {"ros2:rcl_init"})),
              ElementsAre("no program that ran has an event 'ros2:rcl_inti'; did you mean 'ros2:rcl_init'?",
                          "no program that ran has an event 'my_app:*'"));
}

TEST(Absence, OfKnownEventsIsNoneWhereOthersAreThere) {
  // An older tracetools has fewer events.
  EXPECT_THAT(absent_events(rules({"ros2:rcl_init", "ros2:rmw_take_request"}), {"ros2:rcl_init"}), IsEmpty());
  EXPECT_THAT(absent_events(rules({"my_app:*"}), {"my_app:deadline"}), IsEmpty());
}

TEST(Absence, OfLoggersIsToldWhereNoProgramHasTheirModule) {
  RecordedEvents events = rules({"ros2:*"});
  events.python = true;
  EXPECT_THAT(texts(absent_events(events, {"ros2:rcl_init"})),
              ElementsAre("no Python program that ran tells LTTng what it logs: it has to import lttngust, of package "
                          "python3-lttngust"));
  EXPECT_THAT(absent_events(events, {"lttng_python:event"}), IsEmpty());
}

TEST(Absence, OfAnEndedProcessWithBuffersOfItsOwnIsToldOfASnapshot) {
  std::vector<tracing::Stream> streams = {{.domain = "ust", .channel = "ros2", .cpu = "0", .pid = 13}};
  EXPECT_THAT(texts(tracing::absent_from_snapshot(kProcesses, streams)),
              ElementsAre("early [11] had ended, and its buffers with it: its events are not in the snapshot"));
  streams.push_back({.domain = "ust", .channel = "ros2", .cpu = "0", .pid = 11});
  EXPECT_THAT(tracing::absent_from_snapshot(kProcesses, streams), IsEmpty());
}

TEST(Absence, OfEverythingIsToldOnce) {
  EXPECT_THAT(
      texts(absent_events(rules({"ros2:rcl_init", "ros2:rcl_take", "launch:*"}), {"launch:exec"})),
      ElementsAre(
          "no userspace event was recorded: no program that ran has events of the session and was registered with "
          "the session daemon"));
}

TEST(Absence, OfEverythingIsRightWhereNothingWasToBeRecorded) {
  EXPECT_THAT(absent_events(rules({"ros2:rcl_init", "launch:*"}), {"launch:exec"}, true), IsEmpty());
  EXPECT_THAT(texts(absent_events(rules({"ros2:rcl_inti"}), {}, true)),
              ElementsAre(testing::HasSubstr("no program that ran has an event 'ros2:rcl_inti'")));
}

TEST(Absence, IsNotLookedForWithoutRulesOfTheUser) {
  EXPECT_THAT(absent_events(rules({"launch:cut", "ros2_session:no_state_dump"}), {}), IsEmpty());
}

TEST(Absence, OfTheLauncherItselfIsToldOf) {
  EXPECT_THAT(absent_events(rules({"ros2:rcl_init", "launch:*"}), {"ros2:rcl_init", "launch:exec"}), IsEmpty());
  const std::vector<tracing::Absence> absences = absent_events(rules({"ros2:rcl_init", "launch:*"}), {"ros2:rcl_init"});
  EXPECT_THAT(texts(absences), ElementsAre("the launcher's own events are missing: the session daemon had not "
                                           "registered the launcher when the launch ended"));
  EXPECT_TRUE(absences[0].is_loss);
}

TEST(Absence, MakesATraceIncomplete) {
  tracing::LossAccount account;
  EXPECT_TRUE(account.complete());
  account.absences = absent_events(rules({"my_app:*"}), {"ros2:rcl_init"});
  EXPECT_FALSE(account.complete());
  EXPECT_FALSE(account.has_losses()) << "nothing that was fired is missing";
  EXPECT_EQ(tracing::describe_losses(account), "no program that ran has an event 'my_app:*'");
  account.absences = absent_processes(kProcesses);
  EXPECT_TRUE(account.has_losses());
  EXPECT_THAT(tracing::verdict_as_json(account, "run"), testing::HasSubstr("\"absent\": [\n    \"late [12] is"));
}

}  // namespace
