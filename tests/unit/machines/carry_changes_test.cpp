// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "launcher/substitution/machine_view.hpp"

namespace {

using namespace launch;

TEST(CarryChanges, SetsAndRemovesWhatTheLaunchFileHas) {
  const Environment here{{"HOME", "/home/me"}, {"LANG", "C"}, {"GONE", "1"}};
  const Environment now{{"HOME", "/home/me"}, {"LANG", "de"}, {"NEW", "2"}};
  const Environment there{{"HOME", "/home/robot"}, {"GONE", "3"}, {"ONLY_THERE", "4"}};
  EXPECT_EQ(carry_changes(here, now, there),
            Environment({{"HOME", "/home/robot"}, {"LANG", "de"}, {"NEW", "2"}, {"ONLY_THERE", "4"}}));
}

TEST(CarryChanges, AppendsToWhatIsThere) {
  const Environment here{{"PATH", "/here/bin"}, {"LIB", "/here/lib"}};
  const Environment now{{"PATH", "/here/bin:/more"}, {"LIB", "/first:/here/lib"}};
  const Environment there{{"PATH", "/there/bin"}, {"LIB", "/there/lib"}};
  EXPECT_EQ(carry_changes(here, now, there), Environment({{"PATH", "/there/bin:/more"}, {"LIB", "/first:/there/lib"}}));
}

TEST(CarryChanges, ComesBack) {
  const Environment here{{"PATH", "/here/bin"}, {"ROBOT", "x"}};
  const Environment there{{"PATH", "/there/bin"}};
  const Environment now{{"PATH", "/there/bin:/more"}, {"SET", "1"}};
  EXPECT_EQ(carry_changes(there, now, here), Environment({{"PATH", "/here/bin:/more"}, {"ROBOT", "x"}, {"SET", "1"}}));
}

TEST(CarryChanges, AVariableThatIsMissingThereIsSetAsItIs) {
  const Environment here{{"PATH", "/here/bin"}, {"EMPTY", ""}};
  const Environment now{{"PATH", "/here/bin:/more"}, {"EMPTY", "full"}};
  EXPECT_EQ(carry_changes(here, now, Environment({{"EMPTY", "there"}})),
            Environment({{"PATH", "/here/bin:/more"}, {"EMPTY", "full"}}));
}

TEST(CarryChanges, WhatTheLaunchFileHasDecidedCountsEvenIfItHasChangedNothing) {
  const Environment here{{"LANG", "C"}, {"OTHER", "1"}};
  const Environment there{{"LANG", "de"}, {"OTHER", "2"}, {"DISPLAY", ":0"}};
  Environment now = here;
  now.decide("LANG");
  now.decide("DISPLAY");
  const Environment carried = carry_changes(here, now, there);
  EXPECT_EQ(carried, Environment({{"LANG", "C"}, {"OTHER", "2"}}));
  EXPECT_EQ(carry_changes(there, carried, Environment({{"LANG", "fr"}, {"DISPLAY", ":1"}, {"OTHER", "3"}})),
            Environment({{"LANG", "C"}, {"OTHER", "3"}}));
}

}  // namespace
