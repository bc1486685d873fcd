// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/user/status_line.hpp"

#include <signal.h>

#include <optional>

#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

class StatusLineTest : public LaunchServiceTest {
 protected:
  StatusLineTest() {
    on_service = [this](LaunchService& service) {
      line_.emplace(loop_, supervisor_, service.steering(), [this](const std::string& text) {
        if (text != (shown_.empty() ? "" : shown_.back())) {
          shown_.push_back(text);
        }
      });
      service.observe_suspension([this](bool stops) { line_->suspend(stops); });
      end_ = loop_.after(20s, [&service] { service.end("the test"); });
    };
  }

  std::vector<std::string> shown_;
  std::optional<StatusLine> line_;
  EventLoop::SourcePtr end_;
};

TEST_F(StatusLineTest, SaysNothingWhenEverythingIsQuick) {
  EXPECT_EQ(run(R"xml(<executable cmd="talker"/><executable cmd="listener"/>)xml"), 0);
  EXPECT_THAT(shown_, IsEmpty());
}

TEST_F(StatusLineTest, TellsWhatIsWaitedFor) {
  runner_.script("map", {{.exits_after = 2s}});
  EXPECT_EQ(run(R"xml(<executable name="map" cmd="map"/>
    <executable name="planner" cmd="planner"><depends_on process="map" condition="exited"/></executable>)xml"),
            0);
  EXPECT_THAT(shown_, ElementsAre("starting 1 of 2, waiting: planner", ""));
}

TEST_F(StatusLineTest, CountsDownWhileItStops) {
  runner_.script("planner", {{.ignores = {SIGINT}, .dies_after = 1500ms}});
  EXPECT_EQ(run(R"xml(<executable name="talker" cmd="talker"/>
    <executable name="planner" cmd="planner" sigterm_timeout="2.5" sigkill_timeout="3"/>)xml"),
            0);
  EXPECT_THAT(shown_, ElementsAre("stopping: 1 of 2 still run, SIGTERM in 2 s: planner-2",
                                  "stopping: 1 of 2 still run, SIGTERM in 1 s: planner-2",
                                  "stopping: 1 of 2 still run, SIGKILL in 3 s: planner-2",
                                  "stopping: 1 of 2 still run, SIGKILL in 2 s: planner-2", ""));
}

}  // namespace
}  // namespace launch
