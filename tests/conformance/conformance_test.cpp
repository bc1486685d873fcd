// SPDX-License-Identifier: Apache-2.0
// Checks that `launch --dry-run=json` agrees with the recorded behaviour of the reference engine, launch file by launch
// file.
//
// The records come with the files (corpus.tar.xz). deliberate_differences.tsv lists the
// records that differ on purpose, each with its reason; a row that no longer applies fails as well.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sanitized.hpp"

namespace {

namespace fs = std::filesystem;
using test_support::CommandResult;

constexpr const char* kPython = "/usr/bin/python3";  // Debian's, which has python3-yaml
constexpr std::chrono::seconds kTimeout{test_support::kSanitized ? 2300 : 380};

// A file and the kind of its difference.
using Difference = std::pair<std::string, std::string>;

std::set<Difference> deliberate_differences(const std::string& match) {
  std::ifstream table(DELIBERATE_DIFFERENCES);
  std::set<Difference> differences;
  std::string line;
  std::getline(table, line);  // titles
  while (std::getline(table, line)) {
    const std::size_t first = line.find('\t');
    const std::size_t second = line.find('\t', first + 1);
    const std::string file = line.substr(0, first);
    if (std::regex_search(file, std::regex(match))) {
      differences.emplace(file, line.substr(first + 1, second - first - 1));
    }
  }
  return differences;
}

// The parameter is a regular expression that chooses a part of the files. The parts run at the same time.
class Conformance : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (test_support::run_command({kPython, "-c", "import yaml"}).exit_code != 0) {
      GTEST_SKIP() << "skipped, because python3-yaml is not installed";
    }
    directory_ = fs::temp_directory_path() / ("conformance_" + std::to_string(::getpid()));
    fs::create_directories(directory_);
  }
  void TearDown() override {
    if (!directory_.empty()) {
      fs::remove_all(directory_);
    }
  }

  fs::path directory_;
};

TEST_P(Conformance, PlansAgreeWithTheReferenceButForDeliberateDifferences) {
  const fs::path prefix = directory_ / "prefix";
  ASSERT_EQ(test_support::run_command({kPython, MAKE_PREFIX, CORPUS, prefix.string()}).exit_code, 0);
  const fs::path report = directory_ / "report.jsonl";
  std::vector<std::string> words{kPython,
                                 COMPARE,
                                 CORPUS "/expected.jsonl",
                                 "--corpus",
                                 CORPUS "/launch_files",
                                 "--prefix",
                                 prefix.string(),
                                 "--command",
                                 "'" LAUNCH_PROGRAM "' --dry-run=json {file} {args}",
                                 "--match",
                                 GetParam(),
                                 "--first",
                                 "0",
                                 "--report",
                                 report.string()};
  if (!HAS_PYTHON) {
    words.insert(words.end(), {"--lacking", "this build has no Python"});
  }
  const CommandResult result = test_support::run_command({words}, kTimeout);
  ASSERT_FALSE(result.timed_out);
  ASSERT_TRUE(fs::exists(report)) << result.err;
  RecordProperty("summary", result.out.substr(0, result.out.find('\n')));

  const std::set<Difference> deliberate = deliberate_differences(GetParam());
  std::set<Difference> found;
  std::set<std::string> not_comparable;
  std::ifstream lines(report);
  for (std::string line; std::getline(lines, line);) {
    const auto row = nlohmann::json::parse(line);
    const Difference difference(row["file"], row["kind"]);
    if (difference.second == "not comparable") {
      not_comparable.insert(difference.first);
      continue;
    }
    found.insert(difference);
    EXPECT_TRUE(deliberate.contains(difference))
        << difference.first << " (" << row["variant"] << ") " << difference.second << ": " << row["text"];
  }
  for (const Difference& difference : deliberate) {
    // The nodes of these files are of the stack, which a build may lack.
    if (!HAS_STACK && difference.first.find("/tracetools_launch/") != std::string::npos) {
      continue;
    }
    EXPECT_TRUE(found.contains(difference) || not_comparable.contains(difference.first))
        << difference.first << " agrees in " << difference.second << ": remove it from the deliberate differences";
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Conformance, testing::Values("^autoware", "^[^a]|^a[^u]"));

}  // namespace
