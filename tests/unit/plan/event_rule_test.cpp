// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/event_rule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tracing/record/plan/trace_error.hpp"

namespace {

using testing::ElementsAre;
using tracing::EventRule;
using tracing::parse_event_rule;

constexpr const char* kForm = "an event is written: PATTERN [except PATTERN,…] [level [=]LEVEL] [if FILTER]";

std::string rule_error(const std::string& text) {
  try {
    parse_event_rule(text);
  } catch (const tracing::TraceError& error) {
    return std::string(error.what()) + "\n" + error.remedy();
  }
  return "no error";
}

TEST(EventRule, IsANameInTheSimplestCase) {
  const EventRule rule = parse_event_rule("ros2:*");
  EXPECT_EQ(rule.pattern, "ros2:*");
  EXPECT_TRUE(rule.plain());
}

TEST(EventRule, HasExclusionsALevelAndAFilter) {
  const EventRule rule =
      parse_event_rule("ros2:* except ros2:rcl_init,ros2:*take* level =DEBUG if  a == \"if\" && b < 3 ");
  EXPECT_EQ(rule.pattern, "ros2:*");
  EXPECT_THAT(rule.exclusions, ElementsAre("ros2:rcl_init", "ros2:*take*"));
  EXPECT_EQ(rule.log_level, 14);
  EXPECT_TRUE(rule.exactly_that_level);
  EXPECT_EQ(rule.filter, "a == \"if\" && b < 3");
  EXPECT_FALSE(parse_event_rule("a:b level INFO").exactly_that_level);
}

TEST(EventRule, PatternIsFoundInAnyText) {
  EXPECT_THAT(tracing::event_patterns({"a:b if c", "d:*", "", "x what"}), ElementsAre("a:b", "d:*", "", "x"));
}

TEST(EventRule, WhatIsNoRuleIsAnError) {
  EXPECT_EQ(rule_error(""), "event name '' has 0 characters: 1 to 255 are possible\n");
  EXPECT_EQ(rule_error("a:b where c"), std::string("unexpected 'where' in event 'a:b where c'\n") + kForm);
  EXPECT_EQ(rule_error("a:b if"), std::string("event 'a:b if' ends where its filter is expected\n") + kForm);
  EXPECT_EQ(rule_error("a:b except"),
            std::string("event 'a:b except' ends where the events to exclude are expected\n") + kForm);
  EXPECT_EQ(rule_error("a:b level LOUD"),
            "unknown log level 'LOUD' in event 'a:b level LOUD'\n"
            "the levels are EMERG, ALERT, CRIT, ERR, WARNING, NOTICE, INFO, DEBUG_SYSTEM, DEBUG_PROGRAM, "
            "DEBUG_PROCESS, DEBUG_MODULE, DEBUG_UNIT, DEBUG_FUNCTION, DEBUG_LINE, DEBUG");
}

}  // namespace
