// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/overhead.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace tracing::twin {
namespace {

void add_callback(System& system, const std::string& name, std::size_t sends) {
  Callback callback;
  callback.name = name;
  callback.outputs.resize(sends);
  system.callbacks.push_back(callback);
}

Figures of(const std::vector<std::pair<std::string, std::int64_t>>& medians, std::size_t runs = 10) {
  Figures figures;
  for (const auto& [name, median] : medians) {
    figures[{FigureKind::kCallback, name}].assign(runs, median);
  }
  return figures;
}

TEST(Overhead, IsThatOfAllCallbacksThatSendAlike) {
  System system;
  for (const char* name : {"a", "b", "c"}) {
    add_callback(system, name, 0);
  }
  add_callback(system, "sender", 1);
  add_callback(system, "never compared", 2);
  const Figures recorded = of({{"a", 5000}, {"b", 50'000}, {"c", 900'000}, {"sender", 20'000}});
  // The machine was busy while the last one ran.
  add_overheads(recorded, of({{"a", 5900}, {"b", 51'000}, {"c", 990'000}, {"sender", 27'000}}), system);
  EXPECT_EQ(system.callbacks[0].overhead_ns, 1000);
  EXPECT_EQ(system.callbacks[2].overhead_ns, 1000);
  EXPECT_EQ(system.callbacks[3].overhead_ns, 7000);
  EXPECT_EQ(system.callbacks[4].overhead_ns, 0);
  // Once more, with what is left.
  add_overheads(recorded, of({{"a", 5100}, {"b", 50'100}, {"c", 900'000}, {"sender", 20'000}}), system);
  EXPECT_EQ(system.callbacks[0].overhead_ns, 1100);
}

TEST(Overhead, NeedsSomeRuns) {
  System system;
  add_callback(system, "a", 0);
  add_overheads(of({{"a", 5000}}), of({{"a", 9000}}, 9), system);
  EXPECT_EQ(system.callbacks[0].overhead_ns, 0);
}

}  // namespace
}  // namespace tracing::twin
