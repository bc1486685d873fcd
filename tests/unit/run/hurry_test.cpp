// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/end/hurry.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>

#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/process/fake/fake_process_runner.hpp"
#include "tests/unit/run/fake_scope.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

// As if its session daemon were stopped.
class StuckScope : public FakeScope {
 public:
  using FakeScope::FakeScope;
  void end(EventLoop&, Tell, Completion) override {}
};

class HurryTest : public testing::Test {
 protected:
  static ProcessSpec spec(const std::string& name) {
    ProcessSpec result;
    result.name = name;
    result.argv = {"/bin/" + name};
    return result;
  }
  void begin(std::unique_ptr<RunScope> scope) {
    scopes_.begin(std::move(scope), {}, [](const std::optional<LaunchError>&) {});
    loop_.advance(10ms);
  }
  void end_scopes() {
    scopes_.end([](const LaunchError&) {}, [this] { journal_.emplace_back("all ended"); });
    loop_.advance(1s);
  }

  FakeEventLoop loop_;
  FakeProcessRunner runner_{loop_};
  OutputRouter output_{{.screen_fd = -1}};
  ProcessSupervisor supervisor_{loop_, runner_, output_};
  Diary journal_;
  std::vector<std::string> told_;
  std::vector<TimedStep> timing_;
  ActiveScopes scopes_{loop_, [](bool, const std::string&) {}, timing_};
  CrashCollector crashes_{loop_, [](bool, const std::string&) {}};
  Farewell farewell_{loop_,
                     {[](const Invocation&) { return Requests(); }, [](const ProcessCommand&) {}, [](ProcessSpec) {},
                      [this] { journal_.emplace_back("farewell over"); }, [](const std::string&) {}}};
  Hurry hurry_{loop_, supervisor_, scopes_, crashes_, farewell_, [this](LogLevel level, const std::string& text) {
                 told_.push_back((level == LogLevel::kError ? "error: " : "") + text);
               }};
};

TEST_F(HurryTest, TerminatesWhatRunsThenKillsIt) {
  runner_.script("a", {{.ignores = {SIGINT, SIGTERM}}});
  supervisor_.start(spec("a"));
  supervisor_.shutdown();
  hurry_.on_signal("SIGTERM", false);
  EXPECT_EQ(runner_.signals_of(runner_.spawned()[0].pid), (std::vector<int>{SIGINT, SIGTERM}));
  hurry_.on_signal("ctrl-c (SIGINT)", false);
  loop_.run_until_idle();
  EXPECT_EQ(runner_.signals_of(runner_.spawned()[0].pid), (std::vector<int>{SIGINT, SIGTERM, SIGKILL, SIGKILL}))
      << "the last one is for descendants";
  EXPECT_THAT(told_, ElementsAre("user interrupted with SIGTERM again, sent SIGTERM to a-1; SIGKILL follows in 5 s, or "
                                 "with a third signal",
                                 "user interrupted with ctrl-c (SIGINT) again, killing a-1"));
}

TEST_F(HurryTest, CutsTheFarewellShort) {
  supervisor_.start(spec("a"));
  EventHandler handler;
  handler.event = OnShutdown{1000s};
  farewell_.say({{std::make_shared<const EventHandler>(std::move(handler)), {}}});
  farewell_.wait_for(1);
  loop_.run_until_idle();
  EXPECT_THAT(journal_, IsEmpty());
  hurry_.on_signal("SIGTERM", true);
  EXPECT_THAT(journal_, ElementsAre("farewell over"));
  EXPECT_THAT(runner_.signals(), IsEmpty()) << "it ends as it would have ended";
  EXPECT_THAT(told_, ElementsAre("user interrupted with SIGTERM again, ending the actions of on_shutdown"));
}

TEST_F(HurryTest, EndsTracesAtOnceWhenNothingRuns) {
  begin(std::make_unique<FakeScope>("x", false, SourceRange(), journal_));
  hurry_.on_signal("SIGTERM", false);
  end_scopes();
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "end x in a hurry", "ended x", "all ended"));
  EXPECT_THAT(told_, ElementsAre("user interrupted with SIGTERM again, ending at once"));
}

TEST_F(HurryTest, GivesUpOnATraceThatDoesNotAnswer) {
  hurry_.give_up_by([this] { journal_.emplace_back("gives up"); });
  begin(std::make_unique<StuckScope>("x", false, SourceRange(), journal_));
  end_scopes();
  hurry_.on_signal("SIGTERM", false);
  loop_.advance(Hurry::kPatience - 1ms);
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x"));
  loop_.advance(1ms);
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "gives up"));
  EXPECT_THAT(told_, Contains("error: fake (command line) does not answer: giving up, launch-guardian cleans up"));
}

TEST_F(HurryTest, DoesNotGiveUpWhileAProcessRuns) {
  hurry_.give_up_by([this] { journal_.emplace_back("gives up"); });
  runner_.script("a", {{.ignores = {SIGINT, SIGTERM}, .dies_after = 30s}});
  begin(std::make_unique<StuckScope>("x", false, SourceRange(), journal_));
  end_scopes();
  hurry_.on_signal("SIGTERM", false);
  supervisor_.start(spec("a"));
  loop_.advance(Hurry::kPatience);
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x"));
  supervisor_.kill_all();
  loop_.advance(Hurry::kPatience);
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "gives up"));
}

}  // namespace
}  // namespace launch
