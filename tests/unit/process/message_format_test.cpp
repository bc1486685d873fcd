// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/output/message_format.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace launch {
namespace {

std::string formatted(const std::string& format) {
  return MessageFormat(format).line({1700000000.25, 30, "WARNING", "talker-1", "too late"});
}

std::string error_of(const std::string& format) {
  try {
    const MessageFormat parsed(format);
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(MessageFormat, HasThePredefinedNamesOfRos2) {
  EXPECT_EQ(formatted("default"), "[WARNING] [talker-1]: too late");
  EXPECT_EQ(formatted("default_with_timestamp"), "1700000000.2500000 [WARNING] [talker-1]: too late");
}

TEST(MessageFormat, FillsFieldsWithTheirSpecifications) {
  EXPECT_EQ(formatted("{created:.3f} {levelname:>9}|{name:<10}|{levelno:04d} {message}"),
            "1700000000.250   WARNING|talker-1  |0030 too late");
}

TEST(MessageFormat, TakesDoubleBracesAsBraces) {
  EXPECT_EQ(formatted("{{{msg}}}"), "{too late}");
}

TEST(MessageFormat, DecodesEscapesAsPythonDoes) {
  EXPECT_EQ(formatted("\\033[1m{msg}\\x1b[0m\\t\\\\ \\q"), "\033[1mtoo late\033[0m\t\\ \\q");
  EXPECT_EQ(formatted("\\xe9"), "\xC3\xA9");
  EXPECT_EQ(formatted("\\u00e9 \\U0001f600"), "\xC3\xA9 \xF0\x9F\x98\x80");
  EXPECT_EQ(formatted("\\u00e \\ud800 \\uz"), "\\u00e \\ud800 \\uz");
}

TEST(MessageFormat, SaysWhatIsWrong) {
  EXPECT_EQ(error_of("{level} {msg}"),
            "there is no field 'level'; the fields are created, asctime, levelname, levelno, name, msg, process");
  EXPECT_EQ(error_of("{msg"), "a brace has no partner; write {{ or }} for a brace itself");
  EXPECT_EQ(error_of("msg}"), "a brace has no partner; write {{ or }} for a brace itself");
  EXPECT_EQ(error_of("{msg:.3f}"), "a field has a specification that does not suit it");
}

}  // namespace
}  // namespace launch
