// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/preload.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>

#include "tests/support/command.hpp"

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tracing::append_preload;
using tracing::plan_preload;
using tracing::PreloadPlan;

std::string installed(const std::string& name) {
  return "/lib/" + name;
}
std::string only_versioned(const std::string& name) {
  return name.ends_with(".so") ? "" : "/lib/" + name;
}
std::string missing(const std::string&) {
  return "";
}

constexpr const char* kFork = "/lib/liblttng-ust-fork.so";  // preloaded together with every other one

TEST(Preload, RosEventsNeedNothing) {
  EXPECT_THAT(plan_preload({"ros2:rcl_init", "ros2:*", "lttng_ust_statedump:*"}, installed).libraries, IsEmpty());
  EXPECT_THAT(plan_preload({}, installed).libraries, IsEmpty());
}

TEST(Preload, EachProviderHasItsLibrary) {
  const auto library_of = [](const std::string& event) { return plan_preload({event}, installed).libraries; };
  EXPECT_THAT(library_of("lttng_ust_libc:malloc"), ElementsAre("/lib/liblttng-ust-libc-wrapper.so", kFork));
  EXPECT_THAT(library_of("lttng_ust_libc:posix_memalign"), ElementsAre("/lib/liblttng-ust-libc-wrapper.so", kFork));
  EXPECT_THAT(library_of("lttng_ust_pthread:pthread_mutex_unlock"),
              ElementsAre("/lib/liblttng-ust-pthread-wrapper.so", kFork));
  EXPECT_THAT(library_of("lttng_ust_dl:dlopen"), ElementsAre("/lib/liblttng-ust-dl.so", kFork));
  EXPECT_THAT(library_of("lttng_ust_cyg_profile_fast:func_entry"),
              ElementsAre("/lib/liblttng-ust-cyg-profile-fast.so", kFork));
  EXPECT_THAT(library_of("lttng_ust_cyg_profile:func_exit"), ElementsAre("/lib/liblttng-ust-cyg-profile.so", kFork));
}

TEST(Preload, PatternsMatchWholeNamesAsInTheShell) {
  EXPECT_THAT(plan_preload({"lttng_ust_libc:m?ll[aeo]c"}, installed).libraries,
              ElementsAre("/lib/liblttng-ust-libc-wrapper.so", kFork));
  EXPECT_THAT(plan_preload({"lttng_ust_libc:mal", "ust_libc:malloc", "lttng_ust_libc:mallocator"}, installed).libraries,
              IsEmpty());
}

TEST(Preload, BareStarPreloadsEverythingInOrderAndWarnsOfTwoProfilers) {
  const PreloadPlan plan = plan_preload({"*"}, installed);
  EXPECT_THAT(plan.libraries, ElementsAre("/lib/liblttng-ust-libc-wrapper.so", "/lib/liblttng-ust-pthread-wrapper.so",
                                          "/lib/liblttng-ust-dl.so", "/lib/liblttng-ust-cyg-profile-fast.so",
                                          "/lib/liblttng-ust-cyg-profile.so", kFork));
  EXPECT_THAT(plan.warnings,
              ElementsAre("events of both function profilers are enabled: the fast one "
                          "(liblttng-ust-cyg-profile-fast.so) is used, its exit events carry no address"));
}

TEST(Preload, LibraryThatIsNotInstalledIsAWarning) {
  const PreloadPlan plan = plan_preload({"lttng_ust_dl:*"}, missing);
  EXPECT_THAT(plan.libraries, IsEmpty());
  EXPECT_THAT(plan.warnings,
              ElementsAre("liblttng-ust-dl.so is not installed: the events that it provides will be "
                          "missing (package liblttng-ust1)",
                          "liblttng-ust-fork.so is not installed: processes that traced processes fork may hang "
                          "(package liblttng-ust1)"));
}

TEST(Preload, DevelopmentPackageIsNotNeeded) {
  EXPECT_THAT(plan_preload({"lttng_ust_dl:*"}, only_versioned).libraries,
              ElementsAre("/lib/liblttng-ust-dl.so.1", "/lib/liblttng-ust-fork.so.1"));
}

TEST(Preload, FindsTheInstalledLibraries) {
  const PreloadPlan plan = plan_preload({"lttng_ust_libc:malloc"});
  if (!HAS_TRACEPOINTS && plan.libraries.empty()) {
    GTEST_SKIP() << "skipped, because LTTng-UST is not installed (liblttng-ust1)";
  }
  ASSERT_EQ(plan.libraries.size(), 2u);
  EXPECT_TRUE(std::filesystem::exists(plan.libraries[0]));
  EXPECT_TRUE(std::filesystem::exists(plan.libraries[1]));
}

TEST(Preload, IsAppendedToWhatIsThere) {
  EXPECT_EQ(append_preload("", {"/a.so", "/b.so"}), "/a.so:/b.so");
  EXPECT_EQ(append_preload("/x.so", {"/a.so"}), "/x.so:/a.so");
  EXPECT_EQ(append_preload("/x.so", {}), "/x.so");
}

TEST(Preload, LibrariesThatAreThereAreNotRepeated) {
  EXPECT_EQ(append_preload("/a.so /x.so", {"/a.so", "/b.so", "/b.so"}), "/a.so /x.so:/b.so");
  EXPECT_EQ(append_preload("/x.so:/a.so", {"/a.so"}), "/x.so:/a.so");
}

struct LibrarySearch : testing::Test {
  LibrarySearch() {
    std::string name = (std::filesystem::temp_directory_path() / "library-search-XXXXXX").string();
    directory = mkdtemp(name.data());
  }
  ~LibrarySearch() override { std::filesystem::remove_all(directory); }

  std::filesystem::path directory;
};

TEST_F(LibrarySearch, LooksInLdLibraryPathFirst) {
  test_support::write_file(directory / "libc.so.6", "");
  EXPECT_NE(tracing::find_shared_library("libc.so.6"), "");
  setenv("LD_LIBRARY_PATH", (":/nowhere:" + directory.string()).c_str(), 1);
  EXPECT_EQ(tracing::find_shared_library("libc.so.6"), (directory / "libc.so.6").string());
  unsetenv("LD_LIBRARY_PATH");
  EXPECT_EQ(tracing::find_shared_library("libno-such-thing.so"), "");
}

TEST_F(LibrarySearch, ConfigurationFilesAreReadWithTheirIncludes) {
  test_support::write_file(directory / "ld.so.conf", "# first\n/opt/a  # the first\ninclude conf.d/*.conf\n\n/opt/z\n");
  test_support::write_file(directory / "conf.d" / "one.conf", "/opt/one\n");
  test_support::write_file(directory / "conf.d" / "two.conf", "/opt/two\ninclude nothing/*\n");
  EXPECT_THAT(tracing::read_linker_configuration(directory / "ld.so.conf"),
              ElementsAre("/opt/a", "/opt/one", "/opt/two", "/opt/z"));
}

TEST_F(LibrarySearch, ConfigurationThatIncludesItselfEnds) {
  test_support::write_file(directory / "ld.so.conf", "include ld.so.conf\n/opt/a\n");
  EXPECT_THAT(tracing::read_linker_configuration(directory / "ld.so.conf"), testing::Contains("/opt/a"));
}

}  // namespace
