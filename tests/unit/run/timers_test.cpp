// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/handlers/timers.hpp"

#include <gmock/gmock.h>

#include "launcher/process/fake/fake_event_loop.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

class TimersTest : public testing::Test {
 protected:
  FakeEventLoop loop_;
  std::vector<Duration> fired_;
  Timers timers_{loop_, [this](const TimerRequest& request) { fired_.push_back(request.period); }};
};

TEST_F(TimersTest, EachFiresOnceAfterItsPeriod) {
  timers_.start({.period = 2s, .actions = {}, .scope = {}});
  timers_.start({.period = 1s, .actions = {}, .scope = {}});
  EXPECT_THAT(fired_, IsEmpty());
  loop_.advance(1s);
  EXPECT_THAT(fired_, ElementsAre(1s));
  EXPECT_FALSE(timers_.empty());
  loop_.advance(10s);
  EXPECT_THAT(fired_, ElementsAre(1s, 2s));
  EXPECT_TRUE(timers_.empty());
}

TEST_F(TimersTest, AShutdownLeavesThoseThatAskForIt) {
  timers_.start({.period = 1s, .actions = {}, .scope = {}});
  timers_.start({.period = 2s, .cancel_on_shutdown = false, .actions = {}, .scope = {}});
  timers_.shutdown();
  loop_.advance(10s);
  EXPECT_THAT(fired_, ElementsAre(2s));
}

TEST(Timers, AreNotThereAnyMoreWhenTheyFire) {
  FakeEventLoop loop;
  bool empty = false;
  Timers* running = nullptr;
  Timers timers(loop, [&](const TimerRequest&) { empty = running->empty(); });
  running = &timers;
  timers.start({.period = 1s, .actions = {}, .scope = {}});
  loop.advance(1s);
  EXPECT_TRUE(empty);
}

}  // namespace
}  // namespace launch
