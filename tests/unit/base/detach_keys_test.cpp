// SPDX-License-Identifier: Apache-2.0
#include "base/terminal/detach_keys.hpp"

#include <gtest/gtest.h>

namespace launch {
namespace {

DetachKeys keys(std::string_view text) {
  return DetachKeys::parse(text).value();
}

TEST(DetachKeys, AreFoundHoweverTheyCome) {
  DetachKeys usual = keys(DetachKeys::kUsual);
  EXPECT_EQ(usual.text(), "ctrl-p ctrl-q");
  EXPECT_TRUE(usual.add("\020\021").detached);
  EXPECT_FALSE(usual.add("\020").detached);
  EXPECT_TRUE(usual.add("\021").detached);
  const DetachKeys::Outcome outcome = usual.add("ls\r\020\021rest");
  EXPECT_TRUE(outcome.detached);
  EXPECT_EQ(outcome.passed, "ls\r");
}

TEST(DetachKeys, WhatOnlyBeginsLikeThemIsPassedOn) {
  DetachKeys usual = keys(DetachKeys::kUsual);
  EXPECT_EQ(usual.add("a\020").passed, "a");
  EXPECT_EQ(usual.add("b").passed, "\020b");
  EXPECT_EQ(usual.add("\020\020").passed, "\020");
  const DetachKeys::Outcome outcome = usual.add("\021");
  EXPECT_EQ(outcome.passed, "");
  EXPECT_TRUE(outcome.detached);
  DetachKeys repeated = keys("a,a,b");
  EXPECT_EQ(repeated.add("aaa").passed, "a");
  EXPECT_TRUE(repeated.add("b").detached);
}

TEST(DetachKeys, AreTextAsUsersWriteIt) {
  EXPECT_TRUE(keys("ctrl-A").add("\001").detached);
  EXPECT_TRUE(keys("ctrl-],q").add("\035q").detached);
  EXPECT_TRUE(keys("ctrl-@").add(std::string_view("\0", 1)).detached);
  EXPECT_EQ(keys("ctrl-],q").text(), "ctrl-] q");
  for (const char* const wrong : {"ctrl-", "ctrl-1", "ctrl-ab", "space", "a,", ",a", "alt-a", "ctrl-p ctrl-q"}) {
    EXPECT_FALSE(DetachKeys::parse(wrong)) << wrong;
  }
}

TEST(DetachKeys, NoneDetachNothing) {
  DetachKeys none = keys("");
  EXPECT_EQ(none.text(), "");
  const DetachKeys::Outcome outcome = none.add("\020\021");
  EXPECT_EQ(outcome.passed, "\020\021");
  EXPECT_FALSE(outcome.detached);
}

TEST(DetachKeys, AreTakenFromTheWordsOfACommand) {
  EXPECT_EQ(detach_keys_of({"shell"}).text(), "ctrl-p ctrl-q");
  EXPECT_EQ(detach_keys_of({"--detach-keys", "ctrl-a,d", "shell"}).text(), "ctrl-a d");
  EXPECT_EQ(detach_keys_of({"shell", "--detach-keys=ctrl-x"}).text(), "ctrl-x");
  EXPECT_EQ(detach_keys_of({"shell", "--detach-keys=nonsense"}).text(), "ctrl-p ctrl-q");
}

}  // namespace
}  // namespace launch
