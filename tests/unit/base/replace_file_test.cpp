// SPDX-License-Identifier: Apache-2.0
// A file at a place that others can guess is replaced; nothing is written through a link there.
#include "base/files/replace_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct ReplaceFile : testing::Test {
  ReplaceFile() {
    std::string name = (fs::temp_directory_path() / "replace-file-XXXXXX").string();
    directory = mkdtemp(name.data());
    std::ofstream(directory / "target") << "precious\n";
  }
  ~ReplaceFile() override { fs::remove_all(directory); }

  static std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
      found.push_back(entry.path().filename());
    }
    return found;
  }

  template <class Function>
  static int error_of(const Function& function) {
    try {
      function();
      return 0;
    } catch (const std::system_error& error) {
      return error.code().value();
    }
  }

  fs::path directory;
};

TEST_F(ReplaceFile, WritesTheWholeTextAndNothingBeside) {
  const fs::path file = directory / "file";
  launch::replace_file(file, "a longer text\n");
  launch::replace_file(file, "short\n");
  EXPECT_EQ(text_of(file), "short\n");
  EXPECT_THAT(names(), testing::UnorderedElementsAre("file", "target"));
}

TEST_F(ReplaceFile, APlantedLinkIsReplacedAndItsTargetLeftAsItWas) {
  fs::create_symlink("target", directory / "file");
  launch::replace_file(directory / "file", "new\n");
  EXPECT_FALSE(fs::is_symlink(directory / "file"));
  EXPECT_EQ(text_of(directory / "file"), "new\n");
  EXPECT_EQ(text_of(directory / "target"), "precious\n");
}

TEST_F(ReplaceFile, APlantedLinkAtTheNameThatIsWrittenFirstIsPassedOver) {
  const std::string first = ".file." + std::to_string(getpid()) + ".0";
  fs::create_symlink("target", directory / first);
  launch::replace_file(directory / "file", "new\n");
  EXPECT_EQ(text_of(directory / "file"), "new\n");
  EXPECT_EQ(text_of(directory / "target"), "precious\n");
  EXPECT_THAT(names(), testing::UnorderedElementsAre("file", first, "target"));
}

TEST_F(ReplaceFile, WhatCannotBeReplacedStaysAndNothingIsLeftBeside) {
  fs::create_directory(directory / "file");
  EXPECT_EQ(error_of([&] { launch::replace_file(directory / "file", "new\n"); }), EISDIR);
  EXPECT_EQ(error_of([&] { launch::replace_file(directory / "nowhere/file", "new\n"); }), ENOENT);
  EXPECT_THAT(names(), testing::UnorderedElementsAre("file", "target"));
}

TEST_F(ReplaceFile, MakesTheDirectoriesOnTheWay) {
  launch::replace_file(launch::open_or_make_directory(directory / "a/b"), "file", "new\n");
  launch::replace_file(launch::open_or_make_directory(directory / "a/b"), "file", "newer\n");
  EXPECT_EQ(text_of(directory / "a/b/file"), "newer\n");
  EXPECT_EQ(error_of([&] { launch::open_or_make_directory(directory / "target/b"); }), ENOTDIR);
}

TEST_F(ReplaceFile, FollowsALinkOfThisUserOnTheWay) {
  fs::create_directory(directory / "other_disk");
  fs::create_symlink("other_disk", directory / "cache");
  launch::replace_file(launch::open_or_make_directory(directory / "cache/launch"), "file", "new\n");
  EXPECT_EQ(text_of(directory / "other_disk/launch/file"), "new\n");
}

TEST_F(ReplaceFile, FollowsNoLinkOfAnotherUserOnTheWay) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "only root can make a link of another user";
  }
  fs::create_directory(directory / "elsewhere");
  fs::create_symlink("elsewhere", directory / "cache");
  ASSERT_EQ(lchown((directory / "cache").c_str(), 65534, 65534), 0);
  EXPECT_EQ(error_of([&] { launch::open_or_make_directory(directory / "cache/launch"); }), ELOOP);
  EXPECT_TRUE(fs::is_empty(directory / "elsewhere"));
}

}  // namespace
