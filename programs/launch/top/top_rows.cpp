// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/top/top_rows.hpp"

#include <algorithm>

#include "programs/launch/steer/process_text.hpp"

namespace launch {

std::string printable(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\033' && i + 1 < text.size() && text[i + 1] == '[') {
      // "\033[31m": ends with a letter.
      i += 2;
      while (i < text.size() && (text[i] < '@' || text[i] > '~')) {
        ++i;
      }
    } else {
      plain += static_cast<unsigned char>(text[i]) < ' ' || text[i] == '\x7f' ? ' ' : text[i];
    }
  }
  return plain;
}

void TopRows::update(const Json& processes, Time now) {
  const double passed = std::chrono::duration<double>(now - updated_).count();
  const bool first = updated_ == Time{};
  updated_ = now;
  std::map<std::string, Used> used;
  rows_.clear();
  for (const Json& process : processes) {
    TopRow& row = rows_.emplace_back();
    row.name = process.value("name", "");
    row.state = state_text(process);
    row.pid = process.contains("pid") ? process["pid"].dump() : "";
    row.memory = process.value("memory", std::uint64_t{0});
    row.memory_share = process.value("memory_share", -1.0);
    row.restarts = process.value("restarts", std::int64_t{0});
    row.place = place_text(process.value("place", Json()));
    if (!row.pid.empty()) {
      const double seconds = process.value("cpu", 0.0);
      const auto before = used_.find(row.name);
      if (before != used_.end() && before->second.pid == row.pid && passed > 0) {
        row.cpu = std::max(0.0, 100 * (seconds - before->second.cpu) / passed);
      }
      used[row.name] = {row.pid, seconds};
    }
    if (const auto printed = printed_.find(row.name); printed != printed_.end() && !first && passed > 0) {
      row.lines = static_cast<double>(printed->second.count - printed->second.counted) / passed;
    }
  }
  for (auto& [name, printed] : printed_) {
    printed.counted = printed.count;
  }
  used_ = std::move(used);
}

void TopRows::add_line(const std::string& process, std::string_view line) {
  Printed& printed = printed_[process];
  ++printed.count;
  printed.lines.push_back(printable(line));
  if (printed.lines.size() > kKeptLines) {
    printed.lines.pop_front();
  }
}

std::vector<TopRow> TopRows::rows(const std::string& filter, TopSort sort) const {
  std::vector<TopRow> found;
  std::copy_if(rows_.begin(), rows_.end(), std::back_inserter(found), [&](const TopRow& row) {
    return row.name.find(filter) != std::string::npos || row.state.find(filter) != std::string::npos;
  });
  const auto by = [&](auto&& before) { std::stable_sort(found.begin(), found.end(), before); };
  switch (sort) {
    case TopSort::kOrder:
      break;
    case TopSort::kName:
      by([](const TopRow& a, const TopRow& b) { return a.name < b.name; });
      break;
    case TopSort::kCpu:
      by([](const TopRow& a, const TopRow& b) { return a.cpu > b.cpu; });
      break;
    case TopSort::kMemory:
      by([](const TopRow& a, const TopRow& b) { return a.memory > b.memory; });
      break;
    case TopSort::kRestarts:
      by([](const TopRow& a, const TopRow& b) { return a.restarts > b.restarts; });
      break;
    case TopSort::kLines:
      by([](const TopRow& a, const TopRow& b) { return a.lines > b.lines; });
      break;
  }
  return found;
}

std::vector<std::string> TopRows::lines(const std::string& process, const std::string& search) const {
  std::vector<std::string> found;
  if (const auto printed = printed_.find(process); printed != printed_.end()) {
    std::copy_if(printed->second.lines.begin(), printed->second.lines.end(), std::back_inserter(found),
                 [&](const std::string& line) { return line.find(search) != std::string::npos; });
  }
  return found;
}

double TopRows::cpu() const {
  double sum = 0;
  for (const TopRow& row : rows_) {
    sum += row.cpu;
  }
  return sum;
}

std::uint64_t TopRows::memory() const {
  std::uint64_t sum = 0;
  for (const TopRow& row : rows_) {
    sum += row.memory;
  }
  return sum;
}

}  // namespace launch
