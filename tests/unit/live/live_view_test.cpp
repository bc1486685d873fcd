// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/live/live_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/trace_writer/example_system.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"

namespace tracing {
namespace {

// The system that example_system.hpp describes.
class LiveViewOfTheExample : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::write_example_system(directory_.path(), 100);
    TraceReader(directory_.path()).read(view_);
  }
  testing::TemporaryDirectory directory_;
  LiveView view_;
};

TEST_F(LiveViewOfTheExample, TellsRatesLatenciesAndLossesInALine) {
  EXPECT_EQ(view_.line(2), "1360 events/s, 149 callbacks/s, 99 messages/s, latency p50 205 us, p99 205 us, none lost");
}

TEST_F(LiveViewOfTheExample, ShowsSubscriptionsAndCallbacks) {
  EXPECT_EQ(view_.screen(2, {.width = 80}),
            R"(1360 events/s, 149 callbacks/s, 99 messages/s, latency p50 205 us, p99 205 us
none lost

Nodes       callbacks    load  longest  missed
  /filter       50 Hz  2.90 %  4.00 ms       -
  /sensor       50 Hz  1.00 %   200 us       -
  /display      49 Hz  0.24 %  50.0 us       -

Messages, publish to callback   rate     p50     p99     max  dropped
  /scan  to /filter            50 Hz  205 us  205 us  205 us        -
  /points  to /display         49 Hz  205 us  205 us  205 us        1

Callbacks                         rate      p50      p99      max  missed
  /filter subscription /scan     50 Hz   400 us  4.00 ms  4.00 ms       -
  /sensor timer 10 ms            50 Hz   200 us   200 us   200 us       -
  /display subscription /points  49 Hz  50.0 us  50.0 us  50.0 us       -
)");
  EXPECT_EQ(view_.screen(2, {.width = 60, .top = 1}), R"(1360 events/s, 149 callbacks/..atency p50 205 us, p99 205 us
none lost

Nodes, 1 of 3  callbacks    load  longest  missed
  /filter          50 Hz  2.90 %  4.00 ms       -

Messages, publish to callback, 1 of 2   rate     p50     p99     max
  /scan  to /filter            50 Hz  205 us  205 us  205 us

Callbacks, 1 of 3             rate     p50      p99      max
  /filter subs..ption /scan  50 Hz  400 us  4.00 ms  4.00 ms
)");
}

// What a session records of nodes that are older, if nothing tells it of their objects again.
class WithoutInitEvents : public TraceSink {
 public:
  explicit WithoutInitEvents(TraceSink& next) : next_(next) {}
  void on_event(const Event& event) override {
    if (event.name() == "ros2:callback_start" || event.name() == "ros2:callback_end") {
      next_.on_event(event);
    }
  }
  void on_loss(const Loss& loss) override { next_.on_loss(loss); }

 private:
  TraceSink& next_;
};

TEST_F(LiveViewOfTheExample, SaysWhenNodesOfAnotherRos2TellTheirNames) {
  LiveView view;
  WithoutInitEvents callbacks(view);
  TraceReader(directory_.path()).read(callbacks);
  const std::string screen = view.screen(2, {.width = 80});
  EXPECT_THAT(screen, ::testing::HasSubstr(
                          "\nNodes  callbacks    load  longest  missed\n  ?       149 Hz  4.14 %  4.00 ms       -\n"));
  EXPECT_THAT(screen, ::testing::EndsWith(R"(
?  The name of a node is not known: a node of another ROS 2 tells it to a session
   that begins later if its launch has a <trace>, or began with launch --trace
)"));
}

TEST_F(LiveViewOfTheExample, BeginsAnewWhenItIsCleared) {
  view_.clear();
  EXPECT_EQ(view_.line(2), "0 events/s, 0 callbacks/s, 0 messages/s, none lost");
}

TEST_F(LiveViewOfTheExample, ShowsWhatRestsForTenIntervals) {
  view_.clear();
  EXPECT_EQ(view_.screen(2, {}), R"(0 events/s, 0 callbacks/s, 0 messages/s
none lost

Nodes       callbacks    load  longest  missed
  /display       0 Hz  0.00 %        -       -
  /filter        0 Hz  0.00 %        -       -
  /sensor        0 Hz  0.00 %        -       -

Messages, publish to callback  rate  p50  p99  max  dropped
  /scan  to /filter            0 Hz    -    -    -        -
  /points  to /display         0 Hz    -    -    -        1

Callbacks                        rate  p50  p99  max  missed
  /sensor timer 10 ms            0 Hz    -    -    -       -
  /filter subscription /scan     0 Hz    -    -    -       -
  /display subscription /points  0 Hz    -    -    -       -
)");
  for (int i = 0; i < 9; ++i) {
    view_.clear();
  }
  EXPECT_EQ(view_.screen(2, {}), "0 events/s, 0 callbacks/s, 0 messages/s\nnone lost\n");
}

TEST_F(LiveViewOfTheExample, CountsLossesToTheEnd) {
  const Stream stream{"stream", 0, std::nullopt};
  view_.on_loss({.kind = Loss::Kind::kEvents, .stream = &stream, .begin_ns = 1, .end_ns = 2, .count = 7});
  view_.clear();
  EXPECT_EQ(view_.line(1), "0 events/s, 0 callbacks/s, 0 messages/s, 7 lost");
  view_.on_loss({.kind = Loss::Kind::kPackets, .stream = &stream, .begin_ns = 1, .end_ns = 2, .count = 1});
  EXPECT_EQ(view_.line(1), "0 events/s, 0 callbacks/s, 0 messages/s, at least 7 lost");
}

// Times count back from the last event. There are seven changes: the last five are shown.
TEST(LiveView, ShowsTheLastChangesOfConditionsAndPriorities) {
  testing::TemporaryDirectory directory;
  testing::TraceWriter writer(directory.path() / "trace");
  const std::uint16_t id = writer.declare(
      "launch:condition",
      "\t\tinteger { size = 64; align = 8; signed = 1; } _time;\n\t\tstring _condition;\n\t\tstring _change;\n"
      "\t\tstring _file;\n\t\tinteger { size = 32; align = 8; signed = 0; } _line;\n");
  for (std::int64_t i = 1; i <= 7; ++i) {
    std::string payload;
    testing::detail::append(payload, i * 1'000'000'000);
    payload.append("on_rate of topic /scan below 5 Hz in 2s").push_back('\0');
    payload.append(i % 2 == 1 ? "\x1b 3 messages/s" : "5 messages/s").push_back('\0');
    payload.append("a.launch.xml").push_back('\0');
    testing::detail::append(payload, std::uint32_t{3});
    writer.write_raw(0, 1'767'225'600'000'000'000 + i * 1'000'000'000, {70, 70, "launch"}, id, payload);
  }
  writer.finish();
  LiveView view;
  TraceReader(directory.path()).read(view);
  EXPECT_THAT(view.screen(2, {.width = 80}), ::testing::HasSubstr(R"(
While it ran
    -4.000 s  on_rate of topic /scan below 5 Hz in 2s: ? 3 messages/s
    -3.000 s  on_rate of topic /scan below 5 Hz in 2s: 5 messages/s
    -2.000 s  on_rate of topic /scan below 5 Hz in 2s: ? 3 messages/s
    -1.000 s  on_rate of topic /scan below 5 Hz in 2s: 5 messages/s
    +0.000 s  on_rate of topic /scan below 5 Hz in 2s: ? 3 messages/s
)"));
}

// The same model as that of `launch report`.
TEST_F(LiveViewOfTheExample, GivesTheResultsOfTheWholeTraceAtTheEnd) {
  view_.clear();
  TraceAnalysis analysis;
  TraceReader(directory_.path()).read(analysis);
  const Report expected{directory_.path(), analysis.finish(), ""};
  EXPECT_EQ(json_report({directory_.path(), view_.finish(), ""}), json_report(expected));
}

}  // namespace
}  // namespace tracing
