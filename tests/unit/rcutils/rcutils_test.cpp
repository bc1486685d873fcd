// SPDX-License-Identifier: Apache-2.0
// The small C functions that applications use.
#include <gtest/gtest.h>
#include <rcutils/cmdline_parser.h>
#include <rcutils/env.h>
#include <rcutils/error_handling.h>
#include <rcutils/format_string.h>
#include <rcutils/logging_macros.h>
#include <rcutils/process.h>
#include <rcutils/snprintf.h>
#include <rcutils/strdup.h>
#include <rcutils/time.h>
#include <unistd.h>

#include <limits>
#include <string>
#include <vector>

namespace {

std::vector<std::string> lines;

void keep_line(const rcutils_log_location_t*, int severity, const char* name, rcutils_time_point_value_t,
               const char* format, va_list* args) {
  char text[100];
  vsnprintf(text, sizeof(text), format, *args);
  lines.push_back(std::string(rcutils_logging_severity_name(severity)) + " " + name + ": " + text);
}

// A clock that the test sets, in milliseconds.
rcutils_time_point_value_t now_ms = 0;
rcutils_ret_t test_time(rcutils_time_point_value_t* now) {
  *now = now_ms * 1'000'000;
  return RCUTILS_RET_OK;
}

TEST(LoggingMacros, WriteWhatLevelAndConditionLetPass) {
  ASSERT_EQ(rcutils_logging_initialize(), RCUTILS_RET_OK);
  rcutils_logging_set_output_handler(keep_line);
  lines.clear();
  RCUTILS_LOG_INFO("plain %d", 1);
  RCUTILS_LOG_ERROR_NAMED("arm", "named %s", "two");
  RCUTILS_LOG_DEBUG_NAMED("arm", "below the level");
  for (int i = 0; i < 3; ++i) {
    RCUTILS_LOG_WARN_ONCE_NAMED("arm", "once %d", i);
    RCUTILS_LOG_INFO_SKIPFIRST("skipfirst %d", i);
    RCUTILS_LOG_INFO_EXPRESSION(i == 1, "expression %d", i);
    now_ms = 100 * i;
    RCUTILS_LOG_FATAL_THROTTLE(test_time, 150, "throttle %d", i);
  }
  rcutils_logging_set_output_handler(rcutils_logging_console_output_handler);
  EXPECT_EQ(lines, (std::vector<std::string>{"INFO : plain 1", "ERROR arm: named two", "WARN arm: once 0",
                                             "FATAL : throttle 0", "INFO : skipfirst 1", "INFO : expression 1",
                                             "INFO : skipfirst 2", "FATAL : throttle 2"}));
}

TEST(CommandLine, FindsOptionsAndWhatFollowsThem) {
  std::string words[] = {"program", "-s", "sum", "-h"};
  char* argv[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data()};
  EXPECT_TRUE(rcutils_cli_option_exist(argv, argv + 4, "-h"));
  EXPECT_FALSE(rcutils_cli_option_exist(argv, argv + 4, "-x"));
  EXPECT_STREQ(rcutils_cli_get_option(argv, argv + 4, "-s"), "sum");
  EXPECT_EQ(rcutils_cli_get_option(argv, argv + 4, "-h"), nullptr);
  EXPECT_EQ(rcutils_cli_get_option(argv, argv + 4, "-x"), nullptr);
}

TEST(Strings, AreMadeInMemoryOfTheAllocator) {
  const rcutils_allocator_t allocator = rcutils_get_default_allocator();
  char* text = rcutils_format_string(allocator, "%d-%s", 7, "x");
  EXPECT_STREQ(text, "7-x");
  char* copy = rcutils_strndup(text, 2, allocator);
  EXPECT_STREQ(copy, "7-");
  EXPECT_EQ(rcutils_strdup(nullptr, allocator), nullptr);
  allocator.deallocate(text, allocator.state);
  allocator.deallocate(copy, allocator.state);
  EXPECT_EQ(rcutils_snprintf(nullptr, 0, "%d", 1234), 4);
  EXPECT_EQ(rcutils_snprintf(nullptr, 3, "%d", 1234), -1);
}

using TimeAsString = rcutils_ret_t (*)(const rcutils_time_point_value_t*, char*, size_t);

std::string written(TimeAsString write, rcutils_time_point_value_t time, size_t size = 40) {
  char text[40] = "untouched";
  EXPECT_EQ(write(&time, text, size), RCUTILS_RET_OK);
  return text;
}

TEST(Time, IsWrittenAsText) {
  constexpr rcutils_time_point_value_t kTime = 1'500'000'007;
  constexpr auto kLeast = std::numeric_limits<rcutils_time_point_value_t>::min();
  EXPECT_EQ(written(rcutils_time_point_value_as_nanoseconds_string, kTime), "0000000001500000007");
  EXPECT_EQ(written(rcutils_time_point_value_as_nanoseconds_string, -kTime), "-0000000001500000007");
  EXPECT_EQ(written(rcutils_time_point_value_as_seconds_string, kTime), "0000000001.500000007");
  EXPECT_EQ(written(rcutils_time_point_value_as_seconds_string, -kTime), "-0000000001.500000007");
  EXPECT_EQ(written(rcutils_time_point_value_as_seconds_string, kLeast), "-9223372036.854775808");
  EXPECT_EQ(written(rcutils_time_point_value_as_seconds_string, kTime, 5), "0000");
  EXPECT_EQ(written(rcutils_time_point_value_as_seconds_string, kTime, 0), "untouched");
  EXPECT_EQ(written(rcutils_time_point_value_as_date_string, kTime, 0), "untouched");
  ASSERT_TRUE(rcutils_set_env("TZ", "UTC"));
  EXPECT_EQ(written(rcutils_time_point_value_as_date_string, kTime), "1970-01-01 00:00:01.500");
  EXPECT_EQ(written(rcutils_time_point_value_as_date_string, 1'000'000), "1970-01-01 00:00:00.001");
  char small[31];
  EXPECT_EQ(rcutils_time_point_value_as_date_string(&kTime, small, sizeof(small)), RCUTILS_RET_ERROR);
  rcutils_reset_error();
  EXPECT_EQ(rcutils_time_point_value_as_seconds_string(nullptr, small, sizeof(small)), RCUTILS_RET_INVALID_ARGUMENT);
  rcutils_reset_error();
}

TEST(Environment, IsSetAndRead) {
  const char* value = nullptr;
  ASSERT_TRUE(rcutils_set_env("RCUTILS_TEST_VARIABLE", "here"));
  EXPECT_EQ(rcutils_get_env("RCUTILS_TEST_VARIABLE", &value), nullptr);
  EXPECT_STREQ(value, "here");
  ASSERT_TRUE(rcutils_set_env("RCUTILS_TEST_VARIABLE", nullptr));
  EXPECT_EQ(rcutils_get_env("RCUTILS_TEST_VARIABLE", &value), nullptr);
  EXPECT_STREQ(value, "");
  EXPECT_STREQ(rcutils_get_env(nullptr, &value), "argument env_name is null");
  EXPECT_EQ(rcutils_get_pid(), getpid());
}

TEST(Time, RawSteadyTimeNeverGoesBack) {
  rcutils_time_point_value_t before = 0;
  rcutils_time_point_value_t after = 0;
  ASSERT_EQ(rcutils_raw_steady_time_now(&before), RCUTILS_RET_OK);
  ASSERT_EQ(rcutils_raw_steady_time_now(&after), RCUTILS_RET_OK);
  EXPECT_GT(before, 0);
  EXPECT_GE(after, before);
}

}  // namespace
