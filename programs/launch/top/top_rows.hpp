// SPDX-License-Identifier: Apache-2.0
// What `launch top` knows of the processes of a launch: from each answer to "ps", and from the lines that they print.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace launch {

struct TopRow {
  std::string name;
  std::string state;
  std::string pid;  // "" while it does not run
  double cpu = 0;   // percent of a processor since the answer before
  std::uint64_t memory = 0;
  double memory_share = -1;  // of its limit; negative: there is none
  std::int64_t restarts = 0;
  double lines = 0;  // a second
  std::string place;
};

enum class TopSort { kOrder, kName, kCpu, kMemory, kRestarts, kLines };

class TopRows {
 public:
  using Json = nlohmann::ordered_json;
  using Time = std::chrono::steady_clock::time_point;

  static constexpr std::size_t kKeptLines = 1000;  // of each process

  // Takes an answer to "ps", whose processes have what they use (add_usage).
  void update(const Json& processes, Time now);
  // A process has printed a line.
  void add_line(const std::string& process, std::string_view line);

  // Those whose name or state holds `filter`, sorted.
  std::vector<TopRow> rows(const std::string& filter, TopSort sort) const;
  // The last lines of a process that hold `search`. Colours and other control characters are taken out.
  std::vector<std::string> lines(const std::string& process, const std::string& search) const;
  double cpu() const;
  std::uint64_t memory() const;

 private:
  struct Printed {
    std::deque<std::string> lines;
    std::uint64_t count = 0;
    std::uint64_t counted = 0;  // at the answer before
  };
  struct Used {
    std::string pid;
    double cpu = 0;  // seconds
  };

  std::vector<TopRow> rows_;
  std::map<std::string, Used> used_;
  std::map<std::string, Printed> printed_;
  Time updated_{};
};

// The text without colours and control characters.
std::string printable(std::string_view text);

}  // namespace launch
