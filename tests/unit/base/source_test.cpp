// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics/source.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/read_source_file.hpp"

namespace launch {
namespace {

TEST(SourceRange, ShowsPathsFromTheWorkingDirectoryOnlyToPersons) {
  const std::string here = std::filesystem::current_path().string();
  const SourceRange below{std::make_shared<const SourceFile>(here + "/demo/a.xml", "abc"), 1, 2};
  EXPECT_EQ(to_string(below), "demo/a.xml:1:2");
  EXPECT_EQ(place_with_path(below), here + "/demo/a.xml:1:2");
  const SourceRange elsewhere{std::make_shared<const SourceFile>(here + "_demo/a.xml", "abc"), 0, 1};
  EXPECT_EQ(to_string(elsewhere), here + "_demo/a.xml:1:1");
  EXPECT_EQ(to_string({std::make_shared<const SourceFile>("../a.xml", "abc"), 0, 1}), "../a.xml:1:1");
  EXPECT_EQ(to_string({}), "command line");
}

TEST(SourceFile, CountsLinesAndColumnsFromOne) {
  const SourceFile file("a.xml", "ab\ncd\n");
  EXPECT_EQ(file.position(0).line, 1U);
  EXPECT_EQ(file.position(0).column, 1U);
  EXPECT_EQ(file.position(4).line, 2U);
  EXPECT_EQ(file.position(4).column, 2U);
  EXPECT_EQ(file.position(6).line, 3U) << "the empty line behind the last line end";
}

TEST(SourceFile, CountsCharactersNotBytesInColumns) {
  const SourceFile file("a.xml", "\xC3\xA4\xE2\x82\xACx");  // ä € x
  EXPECT_EQ(file.position(5).column, 3U);
}

TEST(SourceFile, PositionBehindTheEndIsTheEnd) {
  const SourceFile file("a.xml", "abc");
  EXPECT_EQ(file.position(100).column, 4U);
}

TEST(SourceFile, GivesLinesWithoutTheirEnds) {
  const SourceFile file("a.xml", "one\r\ntwo\n\nfour");
  EXPECT_EQ(file.line(1), "one");
  EXPECT_EQ(file.line(2), "two");
  EXPECT_EQ(file.line(3), "");
  EXPECT_EQ(file.line(4), "four");
  EXPECT_EQ(file.line(5), "");
  EXPECT_EQ(file.line(0), "");
}

TEST(SourceFile, LinesMayEndInCarriageReturnsAlone) {
  const SourceFile file("a.xml", "one\rtwo\r\rfour\r");
  EXPECT_EQ(file.line(1), "one");
  EXPECT_EQ(file.line(2), "two");
  EXPECT_EQ(file.line(3), "");
  EXPECT_EQ(file.line(4), "four");
  EXPECT_EQ(file.position(5).line, 2U);
  EXPECT_EQ(file.position(5).column, 2U);
}

TEST(SourceFile, ReadsAWholeFile) {
  std::string path = "/tmp/launch_source_test_XXXXXX";
  ASSERT_GE(::close(::mkstemp(path.data())), 0);
  const std::string text(200'000, 'x');
  std::ofstream(path) << text;
  EXPECT_EQ(read_source_file(path)->text(), text);
  ::unlink(path.c_str());
}

// A campaign of tests keeps the texts of thousands of small files.
TEST(SourceFile, KeepsNoMoreMemoryThanItsText) {
  std::string path = "/tmp/launch_source_test_XXXXXX";
  ASSERT_GE(::close(::mkstemp(path.data())), 0);
  std::ofstream(path) << "<launch/>";
  EXPECT_LT(read_source_file(path)->text().capacity(), 100U);
  ::unlink(path.c_str());
}

TEST(SourceFile, SaysWhyItCannotBeReadAndWhoIncludedIt) {
  const auto includer = std::make_shared<const SourceFile>("main.launch.xml", "<launch>\n  <include/>\n</launch>\n");
  try {
    read_source_file("/nowhere/x.launch.xml", {includer, 12, 19});
    FAIL() << "read a file that does not exist";
  } catch (const LaunchError& error) {
    EXPECT_STREQ(
        error.what(),
        "main.launch.xml:2:4: error: can't read launch file '/nowhere/x.launch.xml': No such file or directory\n"
        "    2 |   <include/>\n"
        "      |    ^~~~~~~");
  }
  EXPECT_THROW(read_source_file("/tmp"), LaunchError) << "a directory is no launch file";
}

TEST(SourceRange, IsWrittenAsFileLineColumn) {
  const auto file = std::make_shared<const SourceFile>("dir/a.xml", "ab\ncd\n");
  EXPECT_EQ(to_string({file, 4, 5}), "dir/a.xml:2:2");
  EXPECT_EQ(to_string({}), "command line");
}

}  // namespace
}  // namespace launch
