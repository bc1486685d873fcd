// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/findings/printable.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

TEST(Printable, LeavesTextsOfAnyLanguage) {
  EXPECT_EQ(printable("/scan <b>&\"'"), "/scan <b>&\"'");
  EXPECT_EQ(printable("/ключ/鍵/😀"), "/ключ/鍵/😀");
}

TEST(Printable, HasNoControlCharacters) {
  EXPECT_EQ(printable("a\nb\tc\x1b[31m\x7f"), "a?b?c?[31m?");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "??31m")
      << "an escape of the second set";
}

TEST(Printable, HasNoBrokenBytes) {
  EXPECT_EQ(printable("\xff\xfe"), "??");
  EXPECT_EQ(printable("a\xe2\x82"), "a??") << "cut off";
  EXPECT_EQ(printable("\xc0\xaf\xe0\x80\xaf"), "?????") << "longer than needed";
  EXPECT_EQ(printable("\xed\xa0\x80\xf4\x90\x80\x80"), "???????") << "no characters";
}

TEST(Printable, CleansEveryNameOfTheResults) {
  TraceResults results;
  results.overview.processes = {{71, "p\n", 1, false, "h\n"}};
  results.ros2.callbacks.resize(1);
  results.ros2.callbacks[0].node = "/n\n";
  results.ros2.callbacks[0].symbol = "s\n";
  results.ros2.chains.resize(1);
  results.ros2.chains[0].steps.resize(1);
  results.ros2.chains[0].steps[0].topic = "/t\n";
  results.warnings = {"w\n"};
  const TraceResults clean = printable(results);
  EXPECT_EQ(clean.overview.processes[0].name, "p?");
  EXPECT_EQ(clean.overview.processes[0].host, "h?");
  EXPECT_EQ(clean.ros2.callbacks[0].node, "/n?");
  EXPECT_EQ(clean.ros2.callbacks[0].symbol, "s?");
  EXPECT_EQ(clean.ros2.chains[0].steps[0].topic, "/t?");
  EXPECT_EQ(clean.warnings[0], "w?");
}

}  // namespace
}  // namespace tracing
