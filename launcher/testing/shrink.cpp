// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/shrink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <tuple>

#include "launcher/testing/seeds.hpp"

namespace launch {

namespace {

using Set = std::set<std::size_t>;

// Nobody is told of these runs.
class Unseen final : public QueueObserver {
 public:
  void on_progress(std::size_t, std::size_t, const std::vector<std::string>&) override {}
  void on_result(const TestResult&) override {}
};

// One of `parts` parts of the set, which are as equal as possible.
Set part_of(const Set& set, std::size_t number, std::size_t parts) {
  const auto at = [&](std::size_t index) {
    return std::next(set.begin(), static_cast<std::ptrdiff_t>(set.size() * index / parts));
  };
  return {at(number), at(number + 1)};
}

Set without(const Set& set, const Set& part) {
  Set rest;
  std::set_difference(set.begin(), set.end(), part.begin(), part.end(), std::inserter(rest, rest.end()));
  return rest;
}

auto place_of(const TestResult& result) {
  const TestFailure& first = result.failures.front();
  return std::tuple(first.file, first.line, first.column);
}

const TestCase* find_test(const std::vector<TestCase>& tests, const TestResult& result) {
  const auto found = std::find_if(tests.begin(), tests.end(), [&](const TestCase& test) {
    return test.file == result.file && test.name == result.name && test.seed == result.seed;
  });
  return found == tests.end() ? nullptr : &*found;
}

}  // namespace

ShrunkSet shrink(const Set& faults, const std::function<bool(const Set& part)>& fails) {
  ShrunkSet result{.faults = faults};
  std::map<Set, bool> known;
  const auto still_fails = [&](const Set& part) {
    const auto found = known.find(part);
    if (found != known.end()) {
      return found->second;
    }
    ++result.runs;
    return known[part] = fails(part);
  };
  if (still_fails({})) {
    result.faults.clear();
    return result;
  }
  Set& left = result.faults;
  std::size_t parts = 2;
  // A smaller set with which the test fails, among the parts of what is left, or what is left without one of them.
  const auto smaller = [&](bool complement) {
    for (std::size_t number = 0; number < parts; ++number) {
      const Set part = part_of(left, number, parts);
      if (const Set candidate = complement ? without(left, part) : part; still_fails(candidate)) {
        left = candidate;
        parts = complement ? std::max<std::size_t>(parts - 1, 2) : 2;
        return true;
      }
    }
    return false;
  };
  while (left.size() > 1) {
    parts = std::min(parts, left.size());
    if (smaller(false) || smaller(true)) {
      continue;
    }
    if (parts == left.size()) {
      break;
    }
    parts *= 2;
  }
  return result;
}

void shrink_failures(std::vector<TestResult>& results, const std::vector<TestCase>& tests, const Registry& registry,
                     const Environment& environment, const LaunchArguments& arguments, const QueueOptions& options,
                     const std::function<void(const TestResult&)>& tell, bool& interrupted) {
  for (TestResult& result : results) {
    Set faults;
    for (const FaultResult& fault : result.faults) {
      if (!fault.left_out) {
        faults.insert(fault.number);
      }
    }
    const TestCase* const test = find_test(tests, result);
    if (result.passed() || faults.empty() || test == nullptr) {
      continue;
    }
    std::vector<TestCase> one = {*test};
    QueueOptions alone = options;
    alone.rounds = 1;
    alone.retries = 0;
    alone.stop_at_failure = false;
    Unseen unseen;
    Shrunk shrunk{.of = faults.size()};
    std::size_t number = 0;
    const ShrunkSet found = shrink(faults, [&](const Set& part) {
      if (interrupted) {
        return false;
      }
      one.front().faults = part;
      alone.directory = fmt::format("{}/shrink-{:04}-{}", options.directory, &result - results.data() + 1, ++number);
      const std::vector<TestResult> runs = run_tests(one, registry, environment, arguments, alone, unseen, interrupted);
      std::error_code not_empty;
      std::filesystem::remove(alone.directory, not_empty);
      if (interrupted || runs.empty() || runs.front().passed() || place_of(runs.front()) != place_of(result)) {
        return false;
      }
      const TestResult& run = runs.front();
      shrunk.faults.clear();
      std::copy_if(run.faults.begin(), run.faults.end(), std::back_inserter(shrunk.faults),
                   [](const FaultResult& fault) { return !fault.left_out; });
      return true;
    });
    if (interrupted) {
      return;
    }
    shrunk.runs = found.runs;
    if (found.faults == faults) {
      std::copy_if(result.faults.begin(), result.faults.end(), std::back_inserter(shrunk.faults),
                   [](const FaultResult& fault) { return !fault.left_out; });
    }
    one.front().faults = found.faults;
    shrunk.again = command_of(one.front(), arguments);
    result.shrunk = std::move(shrunk);
    tell(result);
  }
}

}  // namespace launch
