// SPDX-License-Identifier: Apache-2.0
// Our own decoder and libbabeltrace2 must read the same data from a trace: each event, each field, each loss.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/trace_writer/random_trace.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_text.hpp"

namespace tracing {
namespace {

using testing::TemporaryDirectory;

class DecoderEquality : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(DecoderEquality, HoldsForRandomTraces) {
  std::size_t lines = 0;
  for (std::uint32_t i = 0; i < 25; ++i) {
    const TemporaryDirectory directory;
    testing::write_random_trace(directory.path(), GetParam() * 1000 + i);
    const auto expected = testing::trace_text(directory.path(), TraceReader::Decoder::kBabeltrace);
    const auto seen = testing::trace_text(directory.path(), TraceReader::Decoder::kDirect);
    ASSERT_EQ(testing::lines_of_babeltrace(seen), expected) << "seed " << GetParam() * 1000 + i;
    lines += seen.size();
  }
  EXPECT_GT(lines, 500u) << "the traces hold something to compare";
}

INSTANTIATE_TEST_SUITE_P(Seeds, DecoderEquality, ::testing::Range(0U, 8U));

}  // namespace
}  // namespace tracing
