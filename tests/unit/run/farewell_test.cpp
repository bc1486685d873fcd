// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/end/farewell.hpp"

#include <gmock/gmock.h>

#include "launcher/process/fake/fake_event_loop.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class FarewellTest : public testing::Test {
 protected:
  static Invocation handler(const std::string& name, Duration timeout) {
    EventHandler handler;
    handler.name = name;
    handler.event = OnShutdown{timeout};
    return {std::make_shared<const EventHandler>(std::move(handler)), {}};
  }

  FakeEventLoop loop_;
  std::vector<std::string> journal_;
  std::vector<ProcessId> starts_;  // by each handler
  std::size_t started_ = 0;
  Farewell farewell_{
      loop_,
      {[this](const Invocation& invocation) {
         journal_.push_back(invocation.handler->name);
         Requests requests;
         requests.processes.resize(starts_.size());
         return requests;
       },
       [](const ProcessCommand&) {}, [this](ProcessSpec) { farewell_.wait_for(starts_[started_++ % starts_.size()]); },
       [this] { journal_.emplace_back("over"); }, [this](const std::string& text) { journal_.push_back(text); }}};
};

TEST_F(FarewellTest, WithoutHandlersItIsOverAtOnce) {
  farewell_.say({});
  EXPECT_THAT(journal_, ElementsAre("over"));
}

TEST_F(FarewellTest, HandlersAreVisitedInALaterTurn) {
  farewell_.say({handler("a", 1s), handler("b", 1s)});
  EXPECT_THAT(journal_, IsEmpty());
  loop_.run_until_idle();
  EXPECT_THAT(journal_, ElementsAre("a", "b", "over"));
}

TEST_F(FarewellTest, AProcessThatCannotStartDoesNotCutTheOthersShort) {
  Farewell* running = nullptr;
  std::vector<std::string> journal;
  ProcessId id = 0;
  Farewell farewell(loop_, {[](const Invocation&) {
                              Requests requests;
                              requests.processes.resize(2);
                              return requests;
                            },
                            [](const ProcessCommand&) {},
                            [&](ProcessSpec) {
                              running->wait_for(++id);
                              if (id == 1) {
                                running->on_done(1);  // it could not start
                              }
                            },
                            [&] { journal.emplace_back("over"); }, [](const std::string&) {}});
  running = &farewell;
  farewell.say({handler("a", 5s)});
  loop_.advance(1s);
  EXPECT_THAT(journal, IsEmpty());
  farewell.on_done(2);
  loop_.run_until_idle();
  EXPECT_THAT(journal, ElementsAre("over"));
}

TEST_F(FarewellTest, IsOverWhenTheLastProcessIsDone) {
  starts_ = {1, 2};
  farewell_.say({handler("a", 5s)});
  loop_.advance(1s);
  farewell_.on_done(2);
  farewell_.on_done(7);  // not a process of the handlers
  loop_.advance(1s);
  EXPECT_THAT(journal_, ElementsAre("a"));
  farewell_.on_done(1);
  EXPECT_THAT(journal_, ElementsAre("a")) << "what tells of an end may still be at work";
  loop_.advance(60s);
  EXPECT_THAT(journal_, ElementsAre("a", "over"));
}

TEST_F(FarewellTest, TheLongestTimeoutEndsIt) {
  starts_ = {1};
  farewell_.say({handler("a", 2s), handler("b", 3s)});
  loop_.advance(2s);
  EXPECT_THAT(journal_, ElementsAre("a", "b"));
  loop_.advance(1s);
  EXPECT_THAT(journal_, ElementsAre("a", "b", HasSubstr("3 s have passed"), "over"));
}

TEST_F(FarewellTest, CutShortItVisitsNothingAndIsOverOnce) {
  farewell_.say({handler("a", 1s)});
  farewell_.end();
  farewell_.end();
  loop_.run_until_idle();
  EXPECT_THAT(journal_, ElementsAre("over"));
}

}  // namespace
}  // namespace launch
