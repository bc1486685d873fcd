// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/handlers/ready_handlers.hpp"

#include <gmock/gmock.h>

#include "launcher/process/fake/fake_event_loop.hpp"

namespace launch {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class FakeCondition : public ReadinessCondition {
 public:
  explicit FakeCondition(bool& watched) : watched_(watched) {}
  ~FakeCondition() override { watched_ = false; }
  void watch(EventLoop&, Done given) override {
    watched_ = true;
    done = std::move(given);
  }
  std::string describe() const override { return "the door is open"; }

  Done done;

 private:
  bool& watched_;
};

class ReadyHandlersTest : public testing::Test {
 protected:
  // Only the handlers own the condition.
  FakeCondition& add(const std::string& name) {
    auto condition = std::make_shared<FakeCondition>(watched_);
    FakeCondition& given = *condition;
    EventHandler handler;
    handler.name = name;
    handler.event = OnceReady{std::move(condition)};
    handlers_.add(std::move(handler));
    return given;
  }

  FakeEventLoop loop_;
  bool watched_ = false;
  std::vector<std::string> journal_;
  ReadyHandlers handlers_{loop_,
                          [this](const std::vector<Invocation>& invocations) {
                            for (const Invocation& invocation : invocations) {
                              journal_.push_back(invocation.handler->name);
                            }
                          },
                          [this](const LaunchError& error) { journal_.emplace_back(error.what()); }};
};

TEST_F(ReadyHandlersTest, AHandlerIsInvokedOnceItsConditionHoldsAndForgotten) {
  FakeCondition& condition = add("a");
  EXPECT_TRUE(watched_);
  EXPECT_THAT(journal_, IsEmpty());
  const ReadinessCondition::Done done = condition.done;
  done(std::nullopt);
  EXPECT_THAT(journal_, ElementsAre("a"));
  EXPECT_FALSE(watched_);
}

TEST_F(ReadyHandlersTest, AConditionThatCannotBeKnownIsAnError) {
  const ReadinessCondition::Done done = add("a").done;
  done("the ROS client has ended");
  EXPECT_THAT(journal_, ElementsAre(HasSubstr("the ROS client has ended")));
}

TEST_F(ReadyHandlersTest, ClearEndsTheWatches) {
  add("a");
  handlers_.clear();
  EXPECT_FALSE(watched_);
}

}  // namespace
}  // namespace launch
