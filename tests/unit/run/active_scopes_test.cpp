// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/scopes/active_scopes.hpp"

#include <gmock/gmock.h>

#include "launcher/process/fake/fake_event_loop.hpp"
#include "tests/unit/run/fake_scope.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

class ActiveScopesTest : public testing::Test {
 protected:
  FakeScope& begin(const std::string& name, bool fails = false) {
    auto scope = std::make_unique<FakeScope>(name, fails, SourceRange(), journal_);
    FakeScope& given = *scope;
    scopes_.begin(std::move(scope), {}, [this](const std::optional<LaunchError>& error) {
      journal_.emplace_back(error ? error->what() : "next");
    });
    loop_.advance(10ms);
    return given;
  }
  void end() {
    scopes_.end([this](const LaunchError& error) { journal_.emplace_back(error.what()); },
                [this] { journal_.emplace_back("all ended"); });
    loop_.advance(1s);
  }

  FakeEventLoop loop_;
  Diary journal_;
  std::vector<TimedStep> timing_;
  ActiveScopes scopes_{loop_, [](bool, const std::string&) {}, timing_};
};

TEST_F(ActiveScopesTest, EndInReverseOrder) {
  begin("x");
  begin("y");
  end();
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "next", "begin y", "begun y", "next", "end y", "ended y",
                                    "end x", "ended x", "all ended"));
}

TEST_F(ActiveScopesTest, OneThatCannotBeginIsNotEnded) {
  begin("x");
  begin("y", true);
  end();
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "next", "begin y", "failed y", HasSubstr("no tracer"),
                                    "end x", "ended x", "all ended"));
}

TEST_F(ActiveScopesTest, AnEndThatFailsLeavesTheOthersToTheirs) {
  begin("x");
  begin("y").fail_at_end();
  journal_.clear();
  end();
  EXPECT_THAT(journal_, ElementsAre("end y", "ended y", HasSubstr("no disk"), "end x", "ended x", "all ended"));
}

TEST_F(ActiveScopesTest, AHurryCountsForScopesThatBeginLater) {
  begin("x");
  scopes_.hurry();
  begin("y");
  journal_.clear();
  end();
  EXPECT_THAT(journal_, ElementsAre("end y in a hurry", "ended y", "end x in a hurry", "ended x", "all ended"));
}

TEST_F(ActiveScopesTest, OnlyThoseThatHaveBegunPrepareProcessesAndHearOfRecords) {
  FakeScope& x = begin("x");
  begin("y", true);
  ProcessSpec spec;
  scopes_.prepare(spec);
  EXPECT_EQ(spec.environment.at("SCOPES"), "x");
  scopes_.record({.name = "talker-1"});
  EXPECT_THAT(x.records, ElementsAre("talker-1"));
  EXPECT_FALSE(scopes_.want_records());
  x.want_records();
  EXPECT_TRUE(scopes_.want_records());
}

}  // namespace
}  // namespace launch
