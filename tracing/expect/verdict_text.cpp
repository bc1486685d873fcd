// SPDX-License-Identifier: Apache-2.0
#include "tracing/expect/verdict_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tracing/expect/event_table.hpp"

namespace launch_trace_testing {

namespace {

std::int64_t excess(const Sample& sample, Bounds bounds) {
  return std::max(sample.ns - bounds.most.count(), bounds.least.count() - sample.ns);
}

}  // namespace

std::string count_text(Count count) {
  if (count.most == 0) {
    return "no";
  }
  if (count.least == count.most) {
    return fmt::format("exactly {}", count.least);
  }
  if (count.most == Count{}.most) {
    return fmt::format("at least {}", count.least);
  }
  if (count.least == 0) {
    return fmt::format("at most {}", count.most);
  }
  return fmt::format("{} to {}", count.least, count.most);
}

std::string bounds_text(Bounds bounds) {
  std::string text;
  if (bounds.most == Bounds{}.most) {
    text = "at least " + duration_text(bounds.least.count());
  } else if (bounds.least.count() <= 0) {
    text = "at most " + duration_text(bounds.most.count());
  } else {
    text = duration_text(bounds.least.count()) + " to " + duration_text(bounds.most.count());
  }
  return bounds.share >= 1 ? text : text + fmt::format(" for {:g} % of them", bounds.share * 100);
}

Verdict verdict_on_samples(const std::string& expected, const std::vector<Sample>& samples, Bounds bounds,
                           const std::function<std::string(const std::vector<Sample>&)>& show) {
  if (samples.empty()) {
    return {false, fmt::format("expected: {}\n     saw: none", expected)};
  }
  std::vector<std::int64_t> sorted;
  std::vector<Sample> outside;
  for (const Sample& sample : samples) {
    sorted.push_back(sample.ns);
    if (sample.ns < bounds.least.count() || sample.ns > bounds.most.count()) {
      outside.push_back(sample);
    }
  }
  std::sort(sorted.begin(), sorted.end());
  std::string text = fmt::format("expected: {}\n     saw: {} of {} outside; least {}, median {}, most {}", expected,
                                 outside.empty() ? "none" : std::to_string(outside.size()), samples.size(),
                                 duration_text(sorted.front()), duration_text(sorted[(sorted.size() - 1) / 2]),
                                 duration_text(sorted.back()));
  // A share of 0.99 allows one of a hundred. The tolerance is for 0.99 not being a number of the machine.
  const double allowed = (1 - bounds.share) * static_cast<double>(samples.size()) + 1e-6;
  const bool holds = static_cast<double>(outside.size()) <= allowed;
  if (!holds) {
    const auto worse = [&](const Sample& a, const Sample& b) { return excess(a, bounds) > excess(b, bounds); };
    std::stable_sort(outside.begin(), outside.end(), worse);
    if (outside.size() > kMostRows) {
      outside.resize(kMostRows);
    }
    std::sort(outside.begin(), outside.end(), [](const Sample& a, const Sample& b) { return a.item < b.item; });
    text += "\nworst:" + show(outside);
  }
  return {holds, text};
}

}  // namespace launch_trace_testing
