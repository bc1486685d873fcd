// SPDX-License-Identifier: Apache-2.0
// Our own decoder and libbabeltrace2 must read the same data from a trace: each event, each field, each loss.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/trace_writer/random_trace.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_text.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

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

// What this process has read, from files or caches: bytes.
std::uint64_t bytes_read() {
  std::ifstream io("/proc/self/io");
  std::string name;
  std::uint64_t bytes = 0;
  io >> name >> bytes;  // rchar:
  return bytes;
}

// As LTTng writes them by default and larger: they are read in parts, and events lie across the parts.
TEST(LargePackets, AreReadInPartsAndEachPartOnce) {
  constexpr int kEvents = 150'000;
  const TemporaryDirectory directory;
  testing::TraceWriter writer(directory.path(), {.packet_size = 4 << 20});
  std::uint64_t random = 1;
  for (int i = 0; i < kEvents; ++i) {
    random = random * 6364136223846793005 + 1442695040888963407;
    const std::string name(i % 5000 == 0 ? 20'000 : (random >> 60) + 1, 'x');
    writer.write(static_cast<unsigned>(i % 2), 1'000 * i, {.vpid = 1, .vtid = 1 + i % 2, .procname = "node"},
                 ros2::RclNodeInit{static_cast<ros2::Handle>(i), 0, name, "/"});
  }
  writer.finish();
  std::uint64_t size = 0;
  for (const auto& file : std::filesystem::directory_iterator(directory.path())) {
    size += file.file_size();
  }
  struct Count : TraceSink {
    int events = 0;
    void on_event(const Event&) override { ++events; }
    void on_loss(const Loss&) override {}
  } count;
  const std::uint64_t before = bytes_read();
  TraceReader(directory.path(), TraceReader::Decoder::kDirect).read(count);
  EXPECT_EQ(count.events, kEvents);
  EXPECT_LT(bytes_read() - before, 3 * size);
  EXPECT_EQ(testing::lines_of_babeltrace(testing::trace_text(directory.path(), TraceReader::Decoder::kDirect)),
            testing::trace_text(directory.path(), TraceReader::Decoder::kBabeltrace));
}

INSTANTIATE_TEST_SUITE_P(Seeds, DecoderEquality, ::testing::Range(0U, 8U));

}  // namespace
}  // namespace tracing
