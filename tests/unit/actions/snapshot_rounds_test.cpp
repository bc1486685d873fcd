// SPDX-License-Identifier: Apache-2.0
// Snapshots of several machines, with machines that answer when the test says so.
#include "actions/trace/snapshot_rounds.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "actions/trace/machines_trace.hpp"
#include "launcher/process/fake/fake_event_loop.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace launch;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

namespace fs = std::filesystem;

class FakeMachine final : public MachineRecorder {
 public:
  struct Taken {
    tracing::SnapshotOrder order;
    Done taken;
    std::string into;
    Done fetched;
    std::vector<bool> left;  // each call of leave()
    bool hurried = false;
  };

  explicit FakeMachine(std::string name) : name_(std::move(name)) {}

  std::vector<std::shared_ptr<Taken>> taken;

  // The snapshot is written there, or it is not.
  void answer(std::size_t number, const Outcome& outcome) { taken.at(number)->taken(outcome); }
  void written(std::size_t number) { answer(number, {.directory = "/there/" + name_ + std::to_string(number)}); }
  void comes(std::size_t number, bool complete = true) {
    fs::create_directories(taken.at(number)->into);
    std::ofstream(taken.at(number)->into + "/verdict.json") << (complete ? R"({"complete": true})" : "{}");
    taken.at(number)->fetched({});
  }

  const std::string& machine() const override { return name_; }
  std::int64_t clock_ahead() const override { return 0; }
  void begin(const std::string&, std::function<void(const std::string&)>, Wish, Done) override {}
  std::unique_ptr<MachineRecording> take_snapshot(tracing::SnapshotOrder order, Done done) override {
    taken.push_back(std::make_shared<Taken>(Taken{std::move(order), std::move(done), {}, {}, {}}));
    return std::make_unique<Recording>(taken.back());
  }
  void end(bool, Done) override {}
  void hurry() override {}
  void fetch(const std::string&, Done) override {}
  std::uint64_t fetched() const override { return 0; }
  void leave(bool) override {}

 private:
  class Recording final : public MachineRecording {
   public:
    explicit Recording(std::shared_ptr<Taken> taken) : taken_(std::move(taken)) {}
    void hurry() override { taken_->hurried = true; }
    void fetch(const std::string& directory, Done done) override {
      taken_->into = directory;
      taken_->fetched = std::move(done);
    }
    std::uint64_t fetched() const override { return 1'500'000; }
    void leave(bool remove) override { taken_->left.push_back(remove); }

   private:
    std::shared_ptr<Taken> taken_;
  };

  std::string name_;
};

class SnapshotRoundsTest : public testing::Test {
 protected:
  SnapshotRounds make(std::size_t limit = 10, bool collects = true) {
    return {loop,
            {.directory = sandbox.directory() / "walk",
             .session = "walk",
             .limit = limit,
             .collects = collects,
             .is_used = [](const std::string& machine) { return machine == "arm"; }},
            nullptr,
            {&arm, &base},
            [this](bool, const std::string& text) { told.push_back(text); },
            {},
            [this] { return unrecorded; }};
  }
  std::vector<fs::path> directories() const {
    std::vector<fs::path> found;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(sandbox.directory() / "walk", none)) {
      found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  static nlohmann::json verdict(const fs::path& directory) {
    std::ifstream file(directory / "verdict.json");
    return nlohmann::json::parse(file);
  }

  test_support::Sandbox sandbox;
  FakeEventLoop loop;
  FakeMachine arm{"arm"};
  FakeMachine base{"base"};
  std::vector<std::string> told;
  std::vector<tracing::MachinePart> unrecorded;
};

TEST(WarningOfClock, IsThereIfItSpoilsTheAgeOfMessages) {
  EXPECT_EQ(warning_of_clock("arm", 3'700'000'000, 5),
            "the clock of machine 'arm' is 3700.000 ms ahead of that of the launch: snapshot-on-late-message takes "
            "messages between machines for so much older or younger than they are");
  EXPECT_THAT(warning_of_clock("arm", -2'600'000, 5), HasSubstr("is 2.600 ms behind that of the launch"));
  EXPECT_EQ(warning_of_clock("arm", 2'400'000, 5), "");
  EXPECT_EQ(warning_of_clock("arm", 3'700'000'000, 0), "");
}

TEST_F(SnapshotRoundsTest, AllMachinesTakeOneForTheMomentOfTheReason) {
  SnapshotRounds rounds = make();
  rounds.want({.reason = "arm:talker-1 died of SIGSEGV", .machine = "arm", .died = "talker-1"});
  rounds.want({.reason = "base: event x", .machine = "base"});
  rounds.want({.reason = "base: event x", .machine = "base"});
  loop.run_until_idle();
  ASSERT_THAT(arm.taken, SizeIs(1));
  ASSERT_THAT(base.taken, SizeIs(1));
  for (const auto& order : {arm.taken[0]->order, base.taken[0]->order}) {
    EXPECT_THAT(order.reasons, ElementsAre("arm:talker-1 died of SIGSEGV", "base: event x"));
    EXPECT_EQ(order.moment, arm.taken[0]->order.moment);
    EXPECT_GT(order.moment, 0);
  }
  EXPECT_THAT(arm.taken[0]->order.died, ElementsAre("talker-1"));
  EXPECT_THAT(base.taken[0]->order.died, IsEmpty());
  // Whatever ends the launch now, the directory says that nothing is there.
  ASSERT_THAT(directories(), SizeIs(1));
  const fs::path directory = directories()[0];
  EXPECT_FALSE(verdict(directory)["complete"]);
  EXPECT_THAT(verdict(directory)["absent"][0].get<std::string>(),
              "the launch has not brought the snapshot of machine 'arm' here");

  arm.written(0);
  base.written(0);
  EXPECT_THAT(verdict(directory)["absent"][0].get<std::string>(),
              "the launch has not fetched the snapshot of machine 'arm', which is in '/there/arm0' there");
  loop.run_until_idle();
  EXPECT_EQ(arm.taken[0]->into, directory / "arm");
  arm.comes(0);
  EXPECT_THAT(told, IsEmpty());
  base.comes(0);
  EXPECT_THAT(told, ElementsAre("snapshot of 2 machines written to: " + directory.string() +
                                " (arm:talker-1 died of SIGSEGV, base: event x)"));
  EXPECT_TRUE(verdict(directory)["complete"]);
  EXPECT_THAT(verdict(directory)["reasons"], ElementsAre("arm:talker-1 died of SIGSEGV", "base: event x"));
  EXPECT_THAT(arm.taken[0]->left, ElementsAre(true));
  EXPECT_THAT(base.taken[0]->left, ElementsAre(true));
}

TEST_F(SnapshotRoundsTest, NeverMoreOptimisticThanTheWorstPart) {
  unrecorded = {{.machine = "late", .problem = "machine 'late' was first used when the trace had begun"}};
  SnapshotRounds rounds = make();
  SnapshotAnswer result;
  rounds.want({.reason = "by hand", .answer = [&](const auto& taken) { result = taken; }});
  loop.run_until_idle();
  arm.answer(0, {.well = false, .lost = true, .error = "the connection to machine 'arm' is lost: it is silent"});
  base.written(0);
  loop.run_until_idle();
  base.comes(0, false);
  EXPECT_EQ(result.directory, directories().at(0));
  EXPECT_FALSE(result.complete);
  const nlohmann::json json = verdict(directories()[0]);
  EXPECT_THAT(json["absent"],
              ElementsAre("the connection to machine 'arm' is lost: it is silent: no snapshot of machine 'arm'",
                          "machine 'late' was first used when the trace had begun"));
  EXPECT_FALSE(json["machines"][1]["complete"]);
  EXPECT_THAT(arm.taken[0]->left, IsEmpty());
  EXPECT_THAT(told.back(), "the snapshot of all machines is incomplete");
}

TEST_F(SnapshotRoundsTest, AMachineWithoutProcessesNeedsNoSnapshot) {
  SnapshotRounds rounds = make();
  rounds.want({.reason = "event"});
  loop.run_until_idle();
  arm.written(0);
  base.answer(0, {.well = false, .error = "LTTng has written no snapshot"});
  loop.run_until_idle();
  arm.comes(0);
  EXPECT_TRUE(verdict(directories().at(0))["complete"]);
  rounds.want({.reason = "event"});
  loop.run_until_idle();
  arm.answer(1, {.well = false, .error = "the disk is full"});
  base.written(1);
  loop.run_until_idle();
  base.comes(1);
  EXPECT_THAT(verdict(directories().at(1))["absent"], ElementsAre("no snapshot of machine 'arm': the disk is full"));
}

TEST_F(SnapshotRoundsTest, OthersAreTakenWhileSnapshotsComeHomeAndTheNewestAreKept) {
  SnapshotRounds rounds = make(2);
  for (std::size_t number = 0; number < 4; ++number) {
    rounds.want({.reason = "event " + std::to_string(number)});
    loop.run_until_idle();
    ASSERT_THAT(arm.taken, SizeIs(number + 1));
    arm.written(number);
    base.written(number);
    loop.run_until_idle();
  }
  // The first one is on its way; those between it and the newest had to go, there and here.
  EXPECT_THAT(arm.taken[1]->left, ElementsAre(true));
  EXPECT_THAT(arm.taken[2]->left, ElementsAre(true));
  EXPECT_THAT(arm.taken[3]->left, IsEmpty());
  EXPECT_THAT(directories(), SizeIs(2));
  arm.comes(0);
  base.comes(0);
  loop.run_until_idle();
  arm.comes(3);
  base.comes(3);
  EXPECT_THAT(directories(), SizeIs(2));
  rounds.want({.reason = "event 4"});
  loop.run_until_idle();
  arm.written(4);
  base.written(4);
  EXPECT_THAT(directories(), SizeIs(2));
  EXPECT_THAT(directories()[1].string(), HasSubstr("-4"));
}

TEST_F(SnapshotRoundsTest, AReasonDuringASnapshotIsForTheNextOne) {
  SnapshotRounds rounds = make();
  rounds.want({.reason = "first"});
  loop.run_until_idle();
  rounds.want({.reason = "second"});
  rounds.want({.reason = "first"});
  loop.run_until_idle();
  ASSERT_THAT(arm.taken, SizeIs(1));
  arm.written(0);
  base.written(0);
  ASSERT_THAT(arm.taken, SizeIs(2));
  EXPECT_THAT(arm.taken[1]->order.reasons, ElementsAre("second", "first"));
}

TEST_F(SnapshotRoundsTest, TheEndWaitsForWhatWasWanted) {
  SnapshotRounds rounds = make();
  bool ended = false;
  rounds.want({.reason = "last"});
  rounds.end([&] { ended = true; });
  std::string refused;
  rounds.want({.reason = "too late", .answer = [&](const auto& result) { refused = result.error; }});
  EXPECT_EQ(refused, "the trace is ending");
  loop.run_until_idle();
  arm.written(0);
  base.written(0);
  loop.run_until_idle();
  EXPECT_FALSE(ended);
  loop.advance(std::chrono::seconds(5));
  EXPECT_THAT(told, ElementsAre("fetching the snapshot of machine 'arm': 1.4 MiB so far",
                                "fetching the snapshot of machine 'base': 1.4 MiB so far"));
  rounds.hurry();
  EXPECT_TRUE(arm.taken[0]->hurried);
  arm.taken[0]->fetched({.well = false, .error = "the launch was to end at once"});
  base.comes(0);
  EXPECT_TRUE(ended);
  EXPECT_THAT(arm.taken[0]->left, ElementsAre(false));
  EXPECT_THAT(verdict(directories()[0])["absent"],
              ElementsAre("the snapshot of machine 'arm' could not be fetched: the launch was to end at once; it is in "
                          "'/there/arm0' there"));
  EXPECT_EQ(verdict(directories()[0])["machines"][0]["left_there"], "/there/arm0");
}

TEST_F(SnapshotRoundsTest, SnapshotsStayThere) {
  SnapshotRounds rounds = make(1, false);
  for (std::size_t number = 0; number < 2; ++number) {
    rounds.want({.reason = "event"});
    loop.run_until_idle();
    arm.written(number);
    base.written(number);
    loop.run_until_idle();
  }
  EXPECT_THAT(arm.taken[0]->left, ElementsAre(true));
  EXPECT_THAT(arm.taken[1]->left, IsEmpty());
  bool ended = false;
  rounds.end([&] { ended = true; });
  loop.run_until_idle();
  EXPECT_TRUE(ended);
  EXPECT_THAT(arm.taken[1]->left, ElementsAre(false));
  ASSERT_THAT(directories(), SizeIs(1));
  EXPECT_FALSE(verdict(directories()[0])["complete"]);
  EXPECT_THAT(verdict(directories()[0])["absent"], IsEmpty());
  EXPECT_EQ(verdict(directories()[0])["machines"][1]["left_there"], "/there/base1");
}

TEST_F(SnapshotRoundsTest, AnswersThatComeTooLateAreNoMatter) {
  {
    SnapshotRounds rounds = make();
    rounds.want({.reason = "event"});
    loop.run_until_idle();
    rounds.want({.reason = "another"});
  }
  arm.written(0);
  base.written(0);
  loop.run_until_idle();
  EXPECT_THAT(arm.taken, SizeIs(1));
}

}  // namespace
