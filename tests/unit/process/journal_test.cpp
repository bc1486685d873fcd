// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/output/journal.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

namespace {

using launch::Environment;
using launch::Journal;
using launch::journal_priority;

TEST(JournalPriority, IsThatOfTheLevel) {
  EXPECT_EQ(journal_priority("[DEBUG] [1.0] [node]: text"), 7);
  EXPECT_EQ(journal_priority("[INFO] [launch]: text"), 6);
  EXPECT_EQ(journal_priority("[WARN] [1.0] [node]: text"), 4);
  EXPECT_EQ(journal_priority("[WARNING] [launch]: text"), 4);
  EXPECT_EQ(journal_priority("[ERROR] [1.0] [node]: text"), 3);
  EXPECT_EQ(journal_priority("[FATAL] [1.0] [node]: text"), 2);
  EXPECT_EQ(journal_priority("[CRITICAL] [launch]: text"), 2);
  EXPECT_EQ(journal_priority("text with [ERROR] in it"), 6);
  EXPECT_EQ(journal_priority(""), 6);
}

TEST(Journal, IsNotBehindAnotherFile) {
  Environment environment;
  EXPECT_EQ(Journal::behind(STDOUT_FILENO, environment), nullptr);
  // As in a program whose output has been redirected since the service manager has started its parent.
  environment.insert_or_assign("JOURNAL_STREAM", "1:2");
  EXPECT_EQ(Journal::behind(STDOUT_FILENO, environment), nullptr);
}

}  // namespace
