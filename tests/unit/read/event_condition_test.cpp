// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/selection/event_condition.hpp"

#include <gtest/gtest.h>

#include "base/diagnostics/diagnostic.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {
namespace {

class EventConditionTest : public ::testing::Test {
 protected:
  // Evaluates the expression for one event, an rcl_publisher_init of process 71.
  bool holds(const std::string& text) {
    const testing::TemporaryDirectory directory;
    testing::TraceWriter writer(directory.path());
    writer.write(2, 1000, testing::Thread{71, 72, "talker"},
                 ros2::RclPublisherInit{0xffffffff00000001, 2, 3, "/chatter", 10});
    writer.finish();
    class Sink : public TraceSink {
     public:
      explicit Sink(const std::string& expression) : expression_(expression) {}
      bool result = false;
      void on_event(const Event& event) override { result = expression_.holds(event); }
      void on_loss(const Loss&) override {}

     private:
      EventCondition expression_;
    } sink(text);
    TraceReader(directory.path()).read(sink);
    return sink.result;
  }

  static std::string error_of(const std::string& text) {
    try {
      EventCondition expression(text);
    } catch (const launch::LaunchError& error) {
      return std::to_string(error.diagnostics().front().where.begin) + ": " + error.diagnostics().front().message;
    }
    return "none";
  }
};

TEST_F(EventConditionTest, ComparesNumbers) {
  EXPECT_TRUE(holds("queue_depth == 10"));
  EXPECT_TRUE(holds("queue_depth>9.5"));
  EXPECT_TRUE(holds("queue_depth <= 10"));
  EXPECT_FALSE(holds("queue_depth < 10"));
  EXPECT_TRUE(holds("queue_depth != -1"));
  EXPECT_TRUE(holds("publisher_handle == 0xffffffff00000001")) << "all 64 bits count";
  EXPECT_FALSE(holds("publisher_handle == 0xffffffff00000002"));
  EXPECT_TRUE(holds("publisher_handle > -5")) << "an unsigned number is not negative";
}

TEST_F(EventConditionTest, ComparesTexts) {
  EXPECT_TRUE(holds("topic_name == \"/chatter\""));
  EXPECT_TRUE(holds("topic_name == '/chatter'"));
  EXPECT_TRUE(holds("topic_name =~ 'chat+er$'"));
  EXPECT_FALSE(holds("topic_name =~ '^chatter'"));
  EXPECT_TRUE(holds("topic_name < '/d'"));
  EXPECT_FALSE(holds("topic_name == 10")) << "a text is no number";
  EXPECT_FALSE(holds("queue_depth == '10'"));
}

TEST_F(EventConditionTest, KnowsTheContexts) {
  EXPECT_TRUE(holds("vpid == 71 && vtid == 72 && cpu_id == 2 && procname == 'talker'"));
}

TEST_F(EventConditionTest, CombinesConditions) {
  EXPECT_TRUE(holds("queue_depth == 1 || queue_depth == 10"));
  EXPECT_FALSE(holds("queue_depth == 1 || queue_depth == 10 && vpid == 1"));
  EXPECT_TRUE(holds("(queue_depth == 1 || queue_depth == 10) && !(vpid == 1)"));
}

TEST_F(EventConditionTest, TakesTheSpellingOfConditionsOnMessages) {
  EXPECT_TRUE(holds("queue_depth == 10 and not vpid == 1 or false"));
  EXPECT_TRUE(holds("9 < queue_depth <= 10 and '/chatter' == topic_name"));
  EXPECT_TRUE(holds("len(topic_name) == 8"));
  EXPECT_FALSE(holds("len(queue_depth) == 2")) << "a number has no length";
  EXPECT_FALSE(holds("len == 8")) << "a field of the name len";
  EXPECT_TRUE(holds("queue_depth != nan"));
}

TEST_F(EventConditionTest, AFieldThatIsNotThereIsFalse) {
  EXPECT_FALSE(holds("callback == 1"));
  EXPECT_FALSE(holds("callback != 1"));
  EXPECT_FALSE(holds("callback"));
  EXPECT_TRUE(holds("!callback"));
  EXPECT_TRUE(holds("topic_name"));
  EXPECT_FALSE(holds("topic_name.x == 1"));
  EXPECT_FALSE(holds("topic_name[3] == 1"));
}

TEST_F(EventConditionTest, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(error_of(""), "0: expected the name of a field");
  EXPECT_EQ(error_of("a = 1"), "2: expected '==' to compare");
  EXPECT_EQ(error_of("a == "), "5: expected a value");
  EXPECT_EQ(error_of("a == b"), "5: 'b' is no number; texts stand in quotes");
  EXPECT_EQ(error_of("a == 'b"), "7: a text has no closing quote");
  EXPECT_EQ(error_of("(a"), "2: expected ')'");
  EXPECT_EQ(error_of("a b"), "2: unexpected 'b'");
  EXPECT_EQ(error_of("a =~ 3"), "5: '=~' needs a text in quotes");
  EXPECT_EQ(error_of("a =~ '('"), "5: '(' is no regular expression");
  EXPECT_EQ(error_of("a &&"), "4: expected the name of a field");
  EXPECT_EQ(error_of("a[x]"), "2: expected the number of an element");
}

}  // namespace
}  // namespace tracing
