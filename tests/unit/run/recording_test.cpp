// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/scopes/recording.hpp"

#include <gmock/gmock.h>

#include "launcher/process/fake/fake_event_loop.hpp"
#include "tests/unit/run/fake_scope.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

class FakeRecorder : public LaunchRecorder {
 public:
  void begin() override { journal.emplace_back("begin"); }
  void drop() override { journal.emplace_back("drop"); }
  void record(LaunchRecord record) override {
    static const std::vector<std::string> names = {"load", "include", "visit",   "ready", "spawn",
                                                   "exec", "exit",    "respawn", "signal"};
    journal.push_back(names.at(static_cast<std::size_t>(record.kind)) + " " + record.name);
  }
  void end() override { journal.emplace_back("end"); }

  std::vector<std::string> journal;
};

class RecordingTest : public testing::Test {
 protected:
  RecordingTest() { recording_.use_recorder(recorder_); }

  void begin_scope(bool wants_records) {
    auto scope = std::make_unique<FakeScope>("x", false, SourceRange(), scope_journal_);
    if (wants_records) {
      scope->want_records();
    }
    scopes_.begin(std::move(scope), {}, [](const std::optional<LaunchError>&) {});
    loop_.advance(1s);
  }
  void tell(decltype(ProcessEvent::what) what) {
    const std::string label = "talker-1";
    const ProcessSpec spec;
    recording_.record(ProcessEvent{1, label, spec, std::move(what)});
  }

  FakeEventLoop loop_;
  Diary scope_journal_;
  std::vector<TimedStep> timing_;
  ActiveScopes scopes_{loop_, [](bool, const std::string&) {}, timing_};
  FakeRecorder recorder_;
  Recording recording_{scopes_};
};

TEST_F(RecordingTest, WithoutAScopeThatWantsThemRecordsAreDroppedRoundAfterRound) {
  begin_scope(false);
  recording_.record(LaunchRecord{.kind = LaunchRecord::Kind::kSpawn, .name = "a"});
  recording_.begin();
  recording_.begin();
  recording_.end();
  EXPECT_THAT(recorder_.journal, ElementsAre("spawn a", "drop", "drop"));
}

TEST_F(RecordingTest, TheFirstScopeThatWantsRecordsBeginsTheRecording) {
  recording_.begin();
  begin_scope(true);
  recording_.begin();
  recording_.begin();
  recording_.end();
  recording_.end();
  EXPECT_THAT(recorder_.journal, ElementsAre("drop", "begin", "end"));
}

TEST_F(RecordingTest, EventsOfProcessesBecomeRecords) {
  tell(ProcessStarted{42});
  tell(SignalSent{15});
  tell(ProcessExited{42, {}, false, true});
  tell(ProcessExited{43, {}, true, false});
  tell(ProcessDone{});
  EXPECT_THAT(recorder_.journal,
              ElementsAre("exec talker-1", "signal talker-1", "exit talker-1", "respawn talker-1", "exit talker-1"));
}

TEST_F(RecordingTest, AVisitFollowsWhatItNoted) {
  Requests requests;
  requests.records.push_back({.kind = LaunchRecord::Kind::kInclude, .name = "b.xml"});
  recording_.record_visit(0, {}, requests);
  EXPECT_THAT(recorder_.journal, ElementsAre("include b.xml", "visit "));
}

}  // namespace
}  // namespace launch
