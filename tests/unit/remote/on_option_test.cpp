// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/remote/on_option.hpp"

#include <gmock/gmock.h>

namespace {

using launch::OnOption;
using launch::take_on_option;
using testing::ElementsAre;

TEST(OnOptionTest, IsTakenOutOfTheWords) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--on", "ssh robot", "talker", "--no-wait"},
                                                {"talker", "--on=ssh robot", "--no-wait"},
                                                {"talker", "--no-wait", "--on", "ssh robot"}}) {
    const OnOption option = take_on_option(words, {});
    EXPECT_EQ(option.connect, "ssh robot");
    EXPECT_THAT(option.words, ElementsAre("talker", "--no-wait"));
    EXPECT_FALSE(option.lacks_value);
  }
}

TEST(OnOptionTest, WithoutItTheWordsStayAndTheCommandRunsHere) {
  const OnOption option = take_on_option({"talker", "--only"}, {});
  EXPECT_EQ(option.connect, "");
  EXPECT_THAT(option.words, ElementsAre("talker", "--only"));
}

TEST(OnOptionTest, TheVariableIsItsDefault) {
  const launch::Environment environment{{"LAUNCH_ON", "docker exec -i robot"}};
  EXPECT_EQ(take_on_option({"talker"}, environment).connect, "docker exec -i robot");
  EXPECT_EQ(take_on_option({"--on", "ssh other"}, environment).connect, "ssh other");
  EXPECT_EQ(take_on_option({"--on="}, environment).connect, "") << "an empty value means here";
  EXPECT_EQ(take_on_option({"--on", ""}, environment).connect, "");
}

TEST(OnOptionTest, HelpNeedsNoConnection) {
  EXPECT_EQ(take_on_option({"--on", "ssh robot", "--help"}, {}).connect, "");
}

TEST(OnOptionTest, NeedsAValue) {
  EXPECT_TRUE(take_on_option({"talker", "--on"}, {}).lacks_value);
}

TEST(OnOptionTest, BehindTwoDashesItIsAWord) {
  const OnOption option = take_on_option({"--", "--on", "x"}, {});
  EXPECT_EQ(option.connect, "");
  EXPECT_THAT(option.words, ElementsAre("--", "--on", "x"));
}

}  // namespace
