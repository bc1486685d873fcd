// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/test_visits.hpp"

#include <gtest/gtest.h>

namespace launch {
namespace {

using Part = TestVisits::Part;

TEST(TestVisits, HaveNoEffectUnlessTheyAreTaken) {
  TestVisits visits;
  EXPECT_EQ(visits.next(), Part::kNothing);
  visits.take(std::nullopt);
  EXPECT_EQ(visits.next(), Part::kExpectations);
}

TEST(TestVisits, VisitTheActionsOfTheChosenOneAlone) {
  TestVisits visits;
  visits.take(1);
  EXPECT_EQ(visits.next(), Part::kNothing);
  EXPECT_EQ(visits.next(), Part::kActionsToo);
  EXPECT_EQ(visits.next(), Part::kNothing);
  EXPECT_FALSE(visits.is_in_test());
}

}  // namespace
}  // namespace launch
