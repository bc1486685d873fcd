// SPDX-License-Identifier: Apache-2.0
// How many bytes recordings had when they ended, by their verdicts, against those that are there now. Thus stream files
// are missed that are gone together with their index.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tracing {

// The files verdict.json in these directories and below them.
std::set<std::filesystem::path> verdict_files(const std::vector<std::filesystem::path>& directories);

// A line for each of these verdicts that says that its recording is damaged.
std::vector<std::string> recorded_damage(const std::vector<std::filesystem::path>& directories);

class RecordedBytes {
 public:
  RecordedBytes() = default;  // knows no verdict
  explicit RecordedBytes(const std::vector<std::filesystem::path>& directories);

  // A line for each verdict that can't be read.
  const std::vector<std::string>& broken() const { return broken_; }

  // Content of packets that is in this directory of a trace. `domain` is "ust" or "kernel". They are those of the
  // verdict in the nearest directory above.
  void add(const std::filesystem::path& trace, const std::string& domain, std::uint64_t bytes);
  // A line for each domain of a recording that has less than its verdict says.
  std::vector<std::string> missing() const;

 private:
  struct Sizes {
    std::filesystem::path directory;  // as the user has given it
    // By domain. One whose packets the verdict does not all know is not there.
    std::map<std::string, std::uint64_t> expected;
    std::map<std::string, std::uint64_t> there;
  };
  std::map<std::filesystem::path, Sizes> recordings_;  // by the canonical path of the verdict's directory
  std::vector<std::string> broken_;
};

}  // namespace tracing
