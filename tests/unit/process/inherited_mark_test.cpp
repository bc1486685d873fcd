// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/inherited_mark.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace launch {
namespace {

constexpr const char* kId = "fedcba9876543210";
constexpr const char* kOther = "0123456789abcdef";

TEST(InheritedMark, TellsLaunchesApart) {
  const InheritedMark one = InheritedMark::make(kId, RLIM_INFINITY);
  const InheritedMark other = InheritedMark::make(kOther, RLIM_INFINITY);
  EXPECT_TRUE(one.is_within(one.value()));
  EXPECT_FALSE(one.is_within(other.value()));
  EXPECT_FALSE(one.is_within(RLIM_INFINITY));
  EXPECT_LT(one.value(), RLIM_INFINITY);
}

TEST(InheritedMark, TheProcessesOfALaunchWithinALaunchBelongToBoth) {
  const InheritedMark outer = InheritedMark::make(kId, RLIM_INFINITY);
  const InheritedMark inner = InheritedMark::make(kOther, outer.value());
  EXPECT_LT(inner.value(), outer.value()) << "a process may only lower its limit";
  EXPECT_TRUE(outer.is_within(inner.value()));
  EXPECT_TRUE(inner.is_within(inner.value()));
  EXPECT_FALSE(inner.is_within(outer.value()));
}

TEST(InheritedMark, ThereIsNoneWhereTheLimitIsTaken) {
  const InheritedMark inner = InheritedMark::make(kOther, InheritedMark::make(kId, RLIM_INFINITY).value());
  for (const InheritedMark none : {InheritedMark::make(kId, inner.value()), InheritedMark::make(kId, 1024)}) {
    EXPECT_EQ(none.value(), 0);
    EXPECT_FALSE(none.is_within(0));
    EXPECT_FALSE(none.is_within(inner.value()));
  }
}

TEST(InheritedMark, IsReadInAnotherProcess) {
  const pid_t child = ::fork();
  if (child == 0) {
    const InheritedMark mark = InheritedMark::give_to_this_process(kId);
    ::_exit(mark.value() == 0 ? 2 : mark.is_on(::getpid()) && !mark.is_on(::getppid()) ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WEXITSTATUS(status) == 2) {
    GTEST_SKIP() << "skipped, because this process has a limit of file locks already";
  }
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace launch
