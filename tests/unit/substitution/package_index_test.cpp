// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/package_index.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/unit/substitution/template_test.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

// Two prefixes: `first` and `second` both hold package "both"; `second` alone holds "demo_nodes" with programs.
class PackageIndexTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "package_index_XXXXXX").string();
    root_ = ::mkdtemp(pattern.data());
    first_ = root_ / "first";
    second_ = root_ / "second";
    add_package(first_, "both");
    add_package(second_, "both");
    add_package(second_, "demo_nodes");
    add_file(second_ / "lib/demo_nodes/talker", true);
    add_file(second_ / "lib/demo_nodes/listener", true);
    add_file(second_ / "lib/demo_nodes/notes.txt", false);
    environment_["AMENT_PREFIX_PATH"] = first_.string() + ":" + (root_ / "gone").string() + "::" + second_.string();
  }
  void TearDown() override { fs::remove_all(root_); }

  static void add_file(const fs::path& path, bool executable) {
    fs::create_directories(path.parent_path());
    std::ofstream(path) << "#!/bin/sh\n";
    fs::permissions(path, executable ? fs::perms::owner_all : fs::perms::owner_read | fs::perms::owner_write);
  }
  static void add_package(const fs::path& prefix, const std::string& name) {
    add_file(prefix / "share/ament_index/resource_index/packages" / name, false);
  }

  template <typename Call>
  static std::string message_of(Call call) {
    try {
      call();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path root_, first_, second_;
  Environment environment_;
  PackageIndex index_;
};

TEST_F(PackageIndexTest, TakesTheFirstPrefixThatHasThePackage) {
  EXPECT_EQ(index_.prefix("both", environment_), first_.string());
  EXPECT_EQ(index_.prefix("demo_nodes", environment_), second_.string());
  EXPECT_EQ(index_.share("demo_nodes", environment_), (second_ / "share/demo_nodes").string());
}

TEST_F(PackageIndexTest, FollowsAChangeOfTheSearchPath) {
  EXPECT_EQ(index_.prefix("both", environment_), first_.string());
  environment_["AMENT_PREFIX_PATH"] = second_.string();
  EXPECT_EQ(index_.prefix("both", environment_), second_.string());
}

TEST_F(PackageIndexTest, SearchesItsOwnPrefixLast) {
  PackageIndex index(second_.string());
  EXPECT_EQ(index.prefix("both", environment_), first_.string());
  environment_ = {};
  EXPECT_EQ(index.prefix("demo_nodes", environment_), second_.string());
}

TEST_F(PackageIndexTest, SaysWhereItSearched) {
  EXPECT_EQ(message_of([&] { index_.prefix("demo", environment_); }),
            "package 'demo' not found, searching: ['" + first_.string() + "', '" + second_.string() + "']");
  environment_ = {};
  EXPECT_EQ(message_of([&] { index_.prefix("demo", environment_); }),
            "package 'demo' not found: environment variable 'AMENT_PREFIX_PATH' is not set or empty");
}

TEST_F(PackageIndexTest, RefusesNamesThatNoPackageCanHave) {
  for (const std::string name : {"", "a", "_a", "../both", "a b"}) {
    EXPECT_EQ(message_of([&] { index_.prefix(name, environment_); }), "'" + name + "' is not a valid package name");
  }
}

TEST_F(PackageIndexTest, FindsProgramsOfAPackage) {
  EXPECT_EQ(index_.executable("talker", "demo_nodes", environment_), (second_ / "lib/demo_nodes/talker").string());
  EXPECT_EQ(index_.executables("demo_nodes", environment_), (std::vector<std::string>{"listener", "talker"}));
  EXPECT_EQ(index_.packages(environment_), (std::vector<std::string>{"both", "demo_nodes"}));
}

TEST_F(PackageIndexTest, TakesAnExecutableWithASlashAsAPath) {
  EXPECT_EQ(index_.executable("/bin/sh", "demo_nodes", environment_), "/bin/sh");
}

TEST_F(PackageIndexTest, SaysWhyAProgramIsNotFound) {
  const std::string libexec = (second_ / "lib/demo_nodes").string();
  EXPECT_EQ(message_of([&] { index_.executable("talkr", "demo_nodes", environment_); }),
            "executable 'talkr' not found on the libexec directory '" + libexec + "'");
  EXPECT_EQ(message_of([&] { index_.executable("notes.txt", "demo_nodes", environment_); }),
            "executable 'notes.txt' not found on the libexec directory '" + libexec + "': '" + libexec +
                "/notes.txt' is not executable");
  EXPECT_EQ(message_of([&] { index_.executable("x", "both", environment_); }),
            "package 'both' found at '" + first_.string() + "', but libexec directory '" + first_.string() +
                "/lib/both' does not exist");
}

TEST_F(PackageIndexTest, SearchesProgramsOnThePathOfTheEnvironment) {
  environment_["PATH"] = (root_ / "gone").string() + ":" + (second_ / "lib/demo_nodes").string();
  EXPECT_EQ(PackageIndex::find_on_path("talker", environment_), (second_ / "lib/demo_nodes/talker").string());
  EXPECT_EQ(PackageIndex::find_on_path("notes.txt", environment_), "") << "not executable";
  EXPECT_EQ(PackageIndex::find_on_path("sh", environment_), "") << "not on this PATH";
  EXPECT_EQ(PackageIndex::find_on_path("/bin/sh", environment_), "/bin/sh");
  EXPECT_EQ(PackageIndex::find_on_path("", environment_), "");
}

TEST_F(PackageIndexTest, SubstitutionsAddThePlaceAndASuggestion) {
  Scope scope = test_scope();
  scope.environment = environment_;
  EXPECT_EQ(parse_template(located("$(exec-in-pkg talker demo_nodes)")).perform(scope),
            (second_ / "lib/demo_nodes/talker").string());
  EXPECT_EQ(parse_template(located("$(find-pkg-share both)/x")).perform(scope), (first_ / "share/both/x").string());
  EXPECT_EQ(parse_template(located("$(find-pkg-prefix both)")).perform(scope), first_.string());
  const std::string searched = "searching: ['" + first_.string() + "', '" + second_.string() + "']";
  EXPECT_EQ(perform_error("$(find-pkg-share demo_node)/x", scope), "t:1:1: error: package 'demo_node' not found, " +
                                                                       searched +
                                                                       "\n    1 | $(find-pkg-share demo_node)/x\n"
                                                                       "      | ^~~~~~~~~~~~~~~~~~~~~~~~~~~\n"
                                                                       "      = help: did you mean 'demo_nodes'?\n");
  EXPECT_EQ(perform_error("$(exec-in-pkg talkr demo_nodes)", scope),
            "t:1:1: error: executable 'talkr' not found on the libexec directory '" +
                (second_ / "lib/demo_nodes").string() +
                "'\n    1 | $(exec-in-pkg talkr demo_nodes)\n"
                "      | ^~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\n"
                "      = help: did you mean 'talker'?\n");
  EXPECT_NE(perform_error("$(exec-in-pkg talker demo_node)", scope).find("did you mean 'demo_nodes'?"),
            std::string::npos);
  EXPECT_EQ(perform_error("$(find-exec talker)", scope),
            "t:1:1: error: executable 'talker' not found on the PATH\n"
            "    1 | $(find-exec talker)\n"
            "      | ^~~~~~~~~~~~~~~~~~~\n"
            "      = help: install it, or extend the PATH\n");
}

}  // namespace
}  // namespace launch
