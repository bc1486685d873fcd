// SPDX-License-Identifier: Apache-2.0
// How fair the turns of callbacks were.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace test_support {

constexpr std::size_t kFairTurns = 2;  // of another one, while one waits

struct Overtaking {
  std::size_t most = 0;   // turns that another one took while this one waited for its turn
  std::size_t times = 0;  // that another one took more than kFairTurns
};

// `turns`: the names of those whose turn it was, one after the other. `name` is one that was always ready. What was
// before its first turn does not count, if it had one: an executor with several threads may execute what it has
// connected while it connects the rest.
inline Overtaking overtaking(const std::vector<std::string>& turns, const std::string& name) {
  Overtaking found;
  std::map<std::string, std::size_t> others;
  const auto first = std::find(turns.begin(), turns.end(), name);
  for (auto at = first == turns.end() ? turns.begin() : first; at != turns.end(); ++at) {
    const std::string& turn = *at;
    if (turn == name) {
      others.clear();
      continue;
    }
    const std::size_t count = ++others[turn];
    found.most = std::max(found.most, count);
    found.times += count == kFairTurns + 1 ? 1 : 0;
  }
  return found;
}

}  // namespace test_support
