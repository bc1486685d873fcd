// SPDX-License-Identifier: Apache-2.0
// Bytes that a full disk or a dying machine has changed end a packet, but never the program.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "tests/support/trace_writer/random_trace.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tests/unit/reader/trace_text.hpp"
#include "tracing/ctf/structure_decoder.hpp"

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

// A flight recorder removes its oldest snapshot, also while somebody reads it.
TEST(DamagedTrace, GivesTheOtherTracesWhenOneIsRemovedMeanwhile) {
  const testing::TemporaryDirectory directory;
  for (const std::uint8_t identity : {std::uint8_t{1}, std::uint8_t{2}}) {
    testing::TraceWriter writer(directory.path() / std::to_string(identity), {.identity = identity});
    writer.write(0, 5, {.vpid = 1, .vtid = 1, .procname = "a"}, ros2::RclTake{1});
    writer.finish();
  }
  class Counter : public TraceSink {
   public:
    std::size_t events = 0;
    void on_event(const Event&) override { ++events; }
    void on_loss(const Loss&) override {}
  } counter;
  TraceReader reader(directory.path(), TraceReader::Decoder::kDirect);
  fs::remove_all(directory.path() / "1");
  try {
    reader.read(counter);
    FAIL() << "no TraceReadError";
  } catch (const TraceReadError& error) {
    EXPECT_EQ(error.what(), "the trace '" + directory.path().string() + "' is damaged or ends early: '" +
                                (directory.path() / "1").string() + "': No such file or directory");
  }
  EXPECT_EQ(counter.events, 1u);
}

ctf::FieldClassPtr array_of(ctf::FieldClassPtr element, std::uint64_t length) {
  ctf::FieldClass array;
  array.kind = ctf::FieldKind::kArray;
  array.element = std::move(element);
  array.length = length;
  return std::make_shared<ctf::FieldClass>(array);
}

TEST(DamagedTrace, ACountAllocatesNoMoreFieldsThanThePacketCanHold) {
  ctf::FieldClass string;
  string.kind = ctf::FieldKind::kString;
  ctf::FieldClass structure;
  structure.kind = ctf::FieldKind::kStructure;
  structure.members = {{"text", std::make_shared<ctf::FieldClass>(string)}};
  const ctf::FieldClassPtr element = std::make_shared<ctf::FieldClass>(structure);
  structure.members.clear();
  const ctf::FieldClassPtr empty = std::make_shared<ctf::FieldClass>(structure);
  const std::uint8_t bytes[8] = {};
  ctf::FieldArena arena;
  std::uint64_t end = 0;
  const std::uint64_t huge = std::uint64_t{1} << 44;  // fewer than the bits that the packet pretends to have
  for (const ctf::FieldClassPtr& type : {element, empty}) {
    EXPECT_THROW(ctf::decode_structure(*array_of(type, huge), bytes, 0, 2 * huge, {}, arena, end), ctf::DamagedPacket);
  }
  EXPECT_EQ(ctf::decode_structure(*array_of(element, 8), bytes, 0, 64, {}, arena, end).length, 8u);
  EXPECT_THROW(ctf::decode_structure(*array_of(element, 9), bytes, 0, 64, {}, arena, end), ctf::DamagedPacket);
  EXPECT_EQ(ctf::decode_structure(*array_of(empty, 3), bytes, 64, 64, {}, arena, end).length, 3u);
}

}  // namespace
}  // namespace tracing
