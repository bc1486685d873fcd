// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/output_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/trace_writer/example_system.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"

namespace tracing {
namespace {

TEST(OutputFiles, APageThatWouldBeTooLargeHoldsTheBeginOfTheTrace) {
  const testing::TemporaryDirectory directory;
  testing::write_example_system(directory.path() / "trace", 100);
  OutputFiles files;
  files.html = directory.path() / "a.html";
  files.csv = directory.path() / "csv";
  const WrittenFiles written = write_files({directory.path() / "trace"}, files, {}, 100);
  EXPECT_THAT(written.lines[0], ::testing::MatchesRegex(".*/a.html: [0-9.]+ kB, the first [0-9]+ ms of 1.02 s"));
  EXPECT_EQ(written.lines[1], files.csv.string());

  std::ifstream page(files.html);
  const std::string text(std::istreambuf_iterator<char>(page), {});
  const std::size_t begin = text.find("id=\"facts\">") + 11;
  const auto facts = nlohmann::json::parse(text.substr(begin, text.find("</script>", begin) - begin));
  EXPECT_EQ(facts["instances"].get<int>() + facts["messages"].get<int>(), 100);
  EXPECT_EQ(facts["whole"]["begin"], 0);
  EXPECT_GT(facts["whole"]["end"], 1'000'000'000);
  EXPECT_EQ(facts["overview"]["events"], 2716) << "of the whole trace";
  std::ifstream rows(files.csv / "callback_instances.csv");
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(rows), {}, '\n'), 299) << "tables hold everything";
}

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// For a page alone, what comes behind its end is not kept.
TEST(OutputFiles, APageIsTheSameAloneAndBesideOtherFiles) {
  const testing::TemporaryDirectory directory;
  testing::write_example_system(directory.path() / "trace", 100);
  for (const std::size_t most : {1U, 2U, 50U, 100U, 333U, 497U, 498U, 499U, 10'000U}) {
    OutputFiles alone;
    alone.html = directory.path() / "alone.html";
    const WrittenFiles written = write_files({directory.path() / "trace"}, alone, {}, most);
    OutputFiles both;
    both.html = directory.path() / "beside.html";
    both.dot = directory.path() / "graph.dot";
    const WrittenFiles beside = write_files({directory.path() / "trace"}, both, {}, most);
    EXPECT_EQ(written.lines[0].substr(written.lines[0].find(": ")), beside.lines[0].substr(beside.lines[0].find(": ")));
    EXPECT_TRUE(content(alone.html) == content(both.html)) << most;
  }
}

}  // namespace
}  // namespace tracing
