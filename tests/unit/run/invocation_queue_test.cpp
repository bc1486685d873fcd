// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/handlers/invocation_queue.hpp"

#include <gmock/gmock.h>

#include "launcher/process/fake/fake_event_loop.hpp"

namespace launch {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class InvocationQueueTest : public testing::Test {
 protected:
  static Invocation invocation(const std::string& name) {
    EventHandler handler;
    handler.name = name;
    return {std::make_shared<const EventHandler>(std::move(handler)), {}};
  }

  FakeEventLoop loop_;
  std::vector<std::string> journal_;
  std::string forgets_;  // the name that the first visited handler forgets
  InvocationQueue queue_{loop_,
                         [this](const Invocation& invocation) {
                           EXPECT_FALSE(queue_.empty());
                           journal_.push_back(invocation.handler->name);
                           queue_.forget(forgets_);
                         },
                         [this] { journal_.emplace_back(queue_.empty() ? "idle" : "next"); }};
};

TEST_F(InvocationQueueTest, EventsKeepTheirOrderAndWaitForALaterTurn) {
  queue_.add({invocation("a"), invocation("b")});
  queue_.add({invocation("c")});
  EXPECT_THAT(journal_, IsEmpty());
  EXPECT_FALSE(queue_.empty());
  loop_.run_until_idle();
  EXPECT_THAT(journal_, ElementsAre("a", "b", "next", "c", "idle"));
}

TEST_F(InvocationQueueTest, AnEventWithoutHandlersIsNone) {
  queue_.add({});
  EXPECT_TRUE(queue_.empty());
  loop_.run_until_idle();
  EXPECT_THAT(journal_, IsEmpty());
}

TEST_F(InvocationQueueTest, AForgottenHandlerStillHearsOfTheEventThatIsBeingVisited) {
  forgets_ = "b";
  queue_.add({invocation("a"), invocation("b")});
  queue_.add({invocation("b"), invocation("c")});
  loop_.run_until_idle();
  EXPECT_THAT(journal_, ElementsAre("a", "b", "next", "c", "idle"));
}

}  // namespace
}  // namespace launch
