// SPDX-License-Identifier: Apache-2.0
// The small C++ functions that applications use.
#include <gtest/gtest.h>

#include <limits>
#include <rcpputils/asserts.hpp>
#include <rcpputils/endian.hpp>
#include <rcpputils/env.hpp>
#include <rcpputils/filesystem_helper.hpp>
#include <rcpputils/find_and_replace.hpp>
#include <rcpputils/find_library.hpp>
#include <rcpputils/join.hpp>
#include <rcpputils/pointer_traits.hpp>
#include <rcpputils/process.hpp>
#include <rcpputils/rolling_mean_accumulator.hpp>
#include <rcpputils/scope_exit.hpp>
#include <rcpputils/shared_library.hpp>
#include <rcpputils/split.hpp>
#include <rcpputils/thread_name.hpp>
#include <rcpputils/time.hpp>
#include <rcpputils/unique_lock.hpp>
#include <thread>
#include <vector>

namespace {

using Strings = std::vector<std::string>;

TEST(Rcpputils, SplitsJoinsAndReplaces) {
  EXPECT_EQ(rcpputils::split("/a//b/", '/'), (Strings{"", "a", "", "b"}));
  EXPECT_EQ(rcpputils::split("/a//b/", '/', true), (Strings{"a", "b"}));
  EXPECT_EQ(rcpputils::split("", '/'), Strings{});
  EXPECT_EQ(rcpputils::join(std::vector<int>{1, 2, 3}, ", "), "1, 2, 3");
  EXPECT_EQ(rcpputils::find_and_replace("aXbX", "X", "XX"), "aXXbXX");
  EXPECT_EQ(rcpputils::find_and_replace("a", "", "b"), "a");
}

TEST(Rcpputils, ChecksThrow) {
  EXPECT_NO_THROW(rcpputils::require_true(true));
  EXPECT_THROW(rcpputils::require_true(false, "no"), std::invalid_argument);
  EXPECT_THROW(rcpputils::check_true(false), rcpputils::IllegalStateException);
#ifndef NDEBUG
  EXPECT_THROW(rcpputils::assert_true(false), rcpputils::AssertionException);
#endif
}

TEST(Rcpputils, DoesSomethingAtTheEndOfAScope) {
  int ends = 0;
  {
    auto counted = rcpputils::make_scope_exit([&] { ++ends; });
    auto moved = std::move(counted);
    auto cancelled = rcpputils::make_scope_exit([&] { ends += 10; });
    cancelled.cancel();
    RCPPUTILS_SCOPE_EXIT(ends += 100);
  }
  EXPECT_EQ(ends, 101);
}

TEST(Rcpputils, ReadsAndSetsTheEnvironment) {
  EXPECT_TRUE(rcpputils::set_env_var("RCPPUTILS_TEST_VARIABLE", "x"));
  EXPECT_EQ(rcpputils::get_env_var("RCPPUTILS_TEST_VARIABLE"), "x");
  EXPECT_TRUE(rcpputils::set_env_var("RCPPUTILS_TEST_VARIABLE", nullptr));
  EXPECT_EQ(rcpputils::get_env_var("RCPPUTILS_TEST_VARIABLE"), "");
  EXPECT_THROW(rcpputils::set_env_var("", "x"), std::runtime_error);
  EXPECT_EQ(rcpputils::get_executable_name(), "rcutils_test");
}

TEST(Rcpputils, KnowsPathsAndTimes) {
  const rcpputils::fs::path path = rcpputils::fs::path("/usr") / "lib" / "a.so";
  EXPECT_EQ(path.string(), "/usr/lib/a.so");
  EXPECT_EQ(path.parent_path().string() + path.extension().string(), "/usr/lib.so");
  EXPECT_TRUE(rcpputils::fs::is_directory("/usr"));
  EXPECT_EQ(rcpputils::convert_to_nanoseconds(std::chrono::milliseconds(2)).count(), 2'000'000);
  EXPECT_THROW(rcpputils::convert_to_nanoseconds(std::chrono::hours(std::numeric_limits<int>::max())),
               std::invalid_argument);
}

static_assert(rcpputils::is_pointer<std::shared_ptr<int>>::value && rcpputils::is_pointer<const int*>::value &&
              !rcpputils::is_pointer<int>::value);
static_assert(std::is_same_v<rcpputils::remove_pointer<std::unique_ptr<int>>::type, int>);

TEST(SharedLibrary, FindsSymbolsUntilItIsUnloaded) {
  rcpputils::SharedLibrary library("libm.so.6");
  EXPECT_TRUE(library.has_symbol("cos"));
  EXPECT_FALSE(library.has_symbol("no_such_symbol"));
  EXPECT_NE(library.get_symbol("cos"), nullptr);
  EXPECT_EQ(library.get_library_path(), "libm.so.6");
  EXPECT_THROW(library.get_symbol("no_such_symbol"), std::runtime_error);
  library.unload_library();
  EXPECT_THROW(library.unload_library(), std::runtime_error);
  EXPECT_THROW(rcpputils::SharedLibrary("/no/such/library.so"), std::runtime_error);
  EXPECT_EQ(rcpputils::get_platform_library_name("x"), "libx.so");
  EXPECT_EQ(rcpputils::path_for_library("/no/such/directory", "x"), "");
}

TEST(RollingMean, IsThatOfTheLastValues) {
  rcpputils::RollingMeanAccumulator<double> mean(2);
  mean.accumulate(1);
  EXPECT_EQ(mean.getRollingMean(), 1);
  mean.accumulate(3);
  mean.accumulate(5);
  EXPECT_EQ(mean.getRollingMean(), 4);
}

TEST(Endian, IsThatOfTheMachine) {
  static_assert(rcpputils::endian::native == rcpputils::endian::little);
}

TEST(ThreadName, IsThatOfTheCurrentThread) {
  std::thread([] {
    rcpputils::set_thread_name("a name that is too long");
    EXPECT_EQ(rcpputils::get_thread_name(), "a name that is ");
  }).join();
}

}  // namespace
