// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/start/rounds.hpp"

#include <gmock/gmock.h>

#include "launcher/process/fake/fake_event_loop.hpp"
#include "tests/unit/run/fake_scope.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

class RoundsTest : public testing::Test {
 protected:
  // A round with a message as its name. A scope whose name begins with "bad" can't begin.
  void add(const std::string& name, const std::vector<std::string>& scopes = {}) {
    Round round;
    round.requests.logs = {name};
    for (const std::string& scope : scopes) {
      round.requests.scopes.push_back(
          std::make_unique<FakeScope>(scope, scope.starts_with("bad"), SourceRange(), journal_));
    }
    rounds_.add(std::move(round));
  }

  FakeEventLoop loop_;
  Diary journal_;
  std::vector<TimedStep> timing_;
  bool starts_slowly_ = false;
  ActiveScopes scopes_{loop_, [](bool, const std::string&) {}, timing_};
  Rounds rounds_{scopes_,
                 {[this](const Round& round) {
                    journal_.push_back("start " + round.requests.logs.front());
                    if (!starts_slowly_) {
                      rounds_.started();
                    }
                  },
                  [this](const LaunchError& error) { journal_.emplace_back(error.what()); },
                  [this] { journal_.emplace_back("empty"); }}};
};

TEST_F(RoundsTest, ARoundWithoutScopesStartsAtOnce) {
  add("a");
  EXPECT_THAT(journal_, ElementsAre("start a", "empty"));
}

TEST_F(RoundsTest, AllScopesOfARoundBeginOneAfterTheOtherBeforeItStarts) {
  add("a", {"x", "y"});
  add("b");
  loop_.advance(1s);
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "begin y", "begun y", "start a", "start b", "empty"));
}

TEST_F(RoundsTest, TheNextRoundWaitsUntilTheOneBeforeHasStarted) {
  starts_slowly_ = true;
  add("a");
  add("b", {"x"});
  loop_.advance(1s);
  EXPECT_THAT(journal_, ElementsAre("start a"));
  EXPECT_FALSE(rounds_.empty());
  rounds_.started();
  loop_.advance(1s);
  EXPECT_THAT(journal_, ElementsAre("start a", "begin x", "begun x", "start b"));
  rounds_.close();
  EXPECT_FALSE(rounds_.empty());
  rounds_.started();
  EXPECT_TRUE(rounds_.empty());
  EXPECT_EQ(journal_.back(), "empty");
}

TEST_F(RoundsTest, AfterCloseTheRoundThatStartsIsTheLast) {
  starts_slowly_ = true;
  add("a");
  add("b");
  rounds_.close();
  rounds_.started();
  EXPECT_THAT(journal_, ElementsAre("start a", "empty"));
}

TEST_F(RoundsTest, AScopeThatCannotBeginDropsItsRoundAndThoseBehind) {
  add("a", {"x", "bad", "z"});
  add("b");
  loop_.advance(1s);
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "begin bad", "failed bad", HasSubstr("no tracer")));
  EXPECT_TRUE(rounds_.empty());
}

TEST_F(RoundsTest, AfterCloseTheScopeThatIsBeginningIsTheLast) {
  add("a", {"x", "y"});
  loop_.advance(5ms);
  rounds_.close();
  EXPECT_FALSE(rounds_.empty());
  loop_.advance(1s);
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "empty"));
  EXPECT_TRUE(rounds_.empty());
}

TEST_F(RoundsTest, AfterCloseAScopeThatCannotBeginLeavesNothing) {
  add("a", {"bad", "y"});
  loop_.advance(5ms);
  rounds_.close();
  loop_.advance(1s);
  EXPECT_THAT(journal_, ElementsAre("begin bad", "failed bad", HasSubstr("no tracer")));
  EXPECT_TRUE(rounds_.empty());
}

}  // namespace
}  // namespace launch
