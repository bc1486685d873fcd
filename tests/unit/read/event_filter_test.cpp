// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/selection/event_filter.hpp"

#include <gtest/gtest.h>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {
namespace {

TEST(Pattern, StarsAndQuestionMarksStandForCharacters) {
  EXPECT_TRUE(matches_pattern("ros2:*", "ros2:rcl_init"));
  EXPECT_TRUE(matches_pattern("*_init", "ros2:rcl_init"));
  EXPECT_TRUE(matches_pattern("*:r*_*i?", "ros2:rcl_node_init_it"));
  EXPECT_TRUE(matches_pattern("*", ""));
  EXPECT_FALSE(matches_pattern("ros2:", "ros2:rcl_init"));
  EXPECT_FALSE(matches_pattern("ros2:?", "ros2:"));
  EXPECT_FALSE(matches_pattern("*_init", "ros2:rcl_init2"));
}

TEST(TimeBound, IsSecondsADateOrATimeAfterTheFirstEvent) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  EXPECT_EQ(TimeBound::parse("12")->ns, 12 * kSecond);
  EXPECT_EQ(TimeBound::parse("1767225600.000000001")->ns, 1767225600 * kSecond + 1);
  EXPECT_EQ(TimeBound::parse("2026-01-01T00:00:00")->ns, 1767225600 * kSecond);
  EXPECT_EQ(TimeBound::parse("2026-01-01T00:00:00.25")->ns, 1767225600 * kSecond + kSecond / 4);
  EXPECT_TRUE(TimeBound::parse("+1.5")->since_first);
  EXPECT_EQ(TimeBound::parse("+1.5")->ns, kSecond * 3 / 2);
  for (const char* text : {"", "x", "-1", "1.x", "2026-01-01", "2026-01-01T00:00:00x", "+", "99999999999999"}) {
    EXPECT_FALSE(TimeBound::parse(text).has_value()) << text;
  }
}

class FilterTest : public ::testing::Test {
 protected:
  // The times of the accepted events, among four events of two processes.
  static std::vector<std::int64_t> accepted(EventFilter filter) {
    const testing::TemporaryDirectory directory;
    testing::TraceWriter writer(directory.path());
    writer.write(0, 100, testing::Thread{71, 71, "ping"}, ros2::RclTake{1});
    writer.write(0, 200, testing::Thread{72, 72, "pong"}, ros2::RclTake{2});
    writer.write(0, 300, testing::Thread{71, 71, "ping"}, ros2::CallbackStart{3, true});
    writer.write(0, 400, testing::Thread{72, 72, "pong"}, ros2::CallbackEnd{3});
    writer.finish();
    class Sink : public TraceSink {
     public:
      explicit Sink(EventFilter& filter) : filter_(filter) {}
      std::vector<std::int64_t> times;
      void on_event(const Event& event) override {
        if (filter_.accepts(event)) {
          times.push_back(event.timestamp_ns);
        }
      }
      void on_loss(const Loss&) override {}

     private:
      EventFilter& filter_;
    } sink(filter);
    TraceReader(directory.path()).read(sink);
    return sink.times;
  }
  using Times = std::vector<std::int64_t>;
};

TEST_F(FilterTest, AcceptsEverythingWithoutConditions) {
  EXPECT_EQ(accepted({}), (Times{100, 200, 300, 400}));
}

TEST_F(FilterTest, ChoosesByName) {
  EventFilter filter;
  filter.events = {"*callback_*", "nothing"};
  EXPECT_EQ(accepted(std::move(filter)), (Times{300, 400}));
}

TEST_F(FilterTest, ChoosesByProcess) {
  EventFilter by_id;
  by_id.processes = {"71"};
  EXPECT_EQ(accepted(std::move(by_id)), (Times{100, 300}));
  EventFilter by_name;
  by_name.processes = {"po*"};
  EXPECT_EQ(accepted(std::move(by_name)), (Times{200, 400}));
}

TEST_F(FilterTest, ChoosesByTime) {
  EventFilter absolute;
  absolute.begin = TimeBound{200, false};
  absolute.end = TimeBound{400, false};
  EXPECT_EQ(accepted(std::move(absolute)), (Times{200, 300}));
  EventFilter relative;
  relative.begin = TimeBound{200, true};
  relative.events = {"*callback*"};
  EXPECT_EQ(accepted(std::move(relative)), (Times{300, 400})) << "counted from the first event of the trace";
}

TEST_F(FilterTest, AllConditionsMustHold) {
  EventFilter filter;
  filter.conditions.emplace_back("message > 0");
  filter.conditions.emplace_back("vpid == 72");
  EXPECT_EQ(accepted(std::move(filter)), (Times{200}));
}

}  // namespace
}  // namespace tracing
