// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/export/output_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/trace_writer/temporary_directory.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public ::testing::Test {
 protected:
  std::string content() const {
    std::ifstream file(path_);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory_.path()), fs::directory_iterator()));
  }
  const testing::TemporaryDirectory directory_;
  const fs::path path_ = directory_.path() / "out";
};

TEST_F(OutputFileTest, ReplacesAnOlderFileWhenItIsComplete) {
  std::ofstream(path_) << "old";
  OutputFile file(path_);
  file.write("new ");
  file.write("text");
  EXPECT_EQ(content(), "old");
  file.finish();
  EXPECT_EQ(content(), "new text");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, LeavesNothingWhenItIsNotFinished) {
  { OutputFile(path_).write("half"); }
  EXPECT_EQ(files(), 0u);
}

TEST_F(OutputFileTest, SaysWhyItCannotBeWritten) {
  const auto error_of = [](const fs::path& path) -> std::string {
    try {
      OutputFile file(path);
      file.write("x");
      file.finish();
    } catch (const OutputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of(directory_.path() / "no/where"),
            "cannot write " + (directory_.path() / "no/where").string() + ": No such file or directory");
  EXPECT_EQ(error_of(directory_.path()), "cannot write " + directory_.path().string() + ": Is a directory");
  EXPECT_EQ(error_of("/dev/full"), "cannot write /dev/full: No space left on device");
}

TEST_F(OutputFileTest, WritesToADevice) {
  OutputFile file("/dev/null");
  file.write("x");
  file.finish();
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace tracing
