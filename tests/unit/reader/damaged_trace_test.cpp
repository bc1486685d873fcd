// SPDX-License-Identifier: Apache-2.0
// Bytes that a full disk or a dying machine has changed end a packet, but never the program.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "tests/support/trace_writer/random_trace.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/unit/reader/trace_text.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// Reads as much as possible. A TraceReadError must report what is wrong.
void read_damaged(const fs::path& directory) {
  try {
    testing::trace_text(directory, TraceReader::Decoder::kDirect);
  } catch (const TraceReadError& error) {
    EXPECT_STRNE(error.what(), "");
  }
}

TEST(DamagedTrace, RandomBytesInAStreamEndAPacketOnly) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const testing::TemporaryDirectory directory;
    testing::write_random_trace(directory.path(), seed);
    const std::string whole = content(directory.path() / "channel_0");
    std::mt19937 random(seed);
    for (int round = 0; round < 10; ++round) {
      std::string damaged = whole;
      for (int i = 0; i < 4; ++i) damaged[random() % damaged.size()] = static_cast<char>(random());
      if (round % 3 == 0) damaged.resize(random() % damaged.size());
      std::ofstream(directory.path() / "channel_0", std::ios::binary) << damaged;
      SCOPED_TRACE(seed);
      read_damaged(directory.path());
    }
  }
}

TEST(DamagedTrace, RandomBytesInTheMetadataAreRefusedOrRead) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const testing::TemporaryDirectory directory;
    testing::write_random_trace(directory.path(), seed);
    const std::string whole = content(directory.path() / "metadata");
    std::mt19937 random(seed);
    for (int round = 0; round < 10; ++round) {
      std::string damaged = whole;
      for (int i = 0; i < 2; ++i) damaged[random() % damaged.size()] = "0123456789{}[]<>=;:a"[random() % 20];
      std::ofstream(directory.path() / "metadata", std::ios::binary) << damaged;
      SCOPED_TRACE(seed);
      read_damaged(directory.path());
    }
  }
}

// The other streams and the earlier packets lose nothing.
TEST(DamagedTrace, GivesWhatStandsBesideTheDamage) {
  const testing::TemporaryDirectory directory;
  testing::write_random_trace(directory.path(), 5);
  const auto whole = testing::trace_text(directory.path(), TraceReader::Decoder::kDirect);
  ASSERT_FALSE(whole.empty());
  std::ofstream(directory.path() / "channel_9", std::ios::binary) << std::string(200, 'x');
  class Counter : public TraceSink {
   public:
    std::size_t items = 0;
    void on_event(const Event&) override { ++items; }
    void on_loss(const Loss&) override { ++items; }
  } counter;
  try {
    TraceReader(directory.path()).read(counter);
    FAIL() << "no TraceReadError";
  } catch (const TraceReadError& error) {
    EXPECT_EQ(error.what(), "the trace '" + directory.path().string() + "' is damaged or ends early: '" +
                                (directory.path() / "channel_9").string() +
                                "', the packet at byte 0: it has no magic number");
    EXPECT_EQ(error.remedy(), "what can be read beside the damage was read");
  }
  EXPECT_EQ(counter.items, whole.size());
}

}  // namespace
}  // namespace tracing
