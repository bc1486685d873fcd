// SPDX-License-Identifier: Apache-2.0
// Bytes that a full disk or a dying machine has changed end a packet, but never the program.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "tests/support/trace_writer/random_trace.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_text.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/ctf/structure_decoder.hpp"
#include "tracing/decode/ctf/trace_class.hpp"

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
      for (int i = 0; i < 4; ++i) {
        damaged[random() % damaged.size()] = static_cast<char>(random());
      }
      if (round % 3 == 0) {
        damaged.resize(random() % damaged.size());
      }
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
      for (int i = 0; i < 2; ++i) {
        damaged[random() % damaged.size()] = "0123456789{}[]<>=;:a"[random() % 20];
      }
      std::ofstream(directory.path() / "metadata", std::ios::binary) << damaged;
      SCOPED_TRACE(seed);
      read_damaged(directory.path());
    }
  }
}

// As LTTng writes metadata: in packets, each with a header of 37 bytes.
std::string in_packets(const std::string& text) {
  constexpr std::size_t kHeader = 37;
  constexpr std::size_t kPacket = 256;
  std::string bytes;
  const auto put = [&bytes](std::uint32_t value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (std::size_t begin = 0; begin < text.size(); begin += kPacket - kHeader) {
    const std::string part = text.substr(begin, kPacket - kHeader);
    put(0x75D11D57);
    bytes.append(16, '\0');  // uuid
    put(0);                  // checksum
    put(static_cast<std::uint32_t>((kHeader + part.size()) * 8));
    put(kPacket * 8);
    bytes += std::string("\0\0\0\1\10", 5);  // no compression, encryption, checksum; 1.8
    bytes += part + std::string(kPacket - kHeader - part.size(), '\0');
  }
  return bytes;
}

// libbabeltrace2, which reads what our own decoder does not know, would wait for the rest for ever.
TEST(DamagedTrace, MetadataThatEndEarlyAreReadAsFarAsTheyGo) {
  const testing::TemporaryDirectory directory;
  testing::write_random_trace(directory.path(), 5);
  const fs::path file = directory.path() / "metadata";
  const std::string whole = in_packets(content(file));
  ASSERT_GT(whole.size(), 1024u);
  const auto write = [&file](const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; };
  write(whole);
  const auto all = testing::trace_text(directory.path(), TraceReader::Decoder::kAny);
  ASSERT_FALSE(all.empty());

  write(whole.substr(0, 200));
  try {
    testing::trace_text(directory.path(), TraceReader::Decoder::kAny);
    FAIL() << "nothing is described";
  } catch (const TraceReadError& error) {
    EXPECT_EQ(error.what(), fmt::format("'{}' is damaged or ends early, before it describes an event", file.string()));
  }

  for (std::size_t size = 290; size < whole.size() - 256; size += 37) {
    SCOPED_TRACE(size);
    write(whole.substr(0, size));
    EXPECT_THROW(testing::trace_text(directory.path(), TraceReader::Decoder::kAny), TraceReadError);
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

// Another program removes the end of a file while it is read. Mapped memory would end the program with SIGBUS.
TEST(DamagedTrace, AFileThatGetsShorterWhileItIsReadIsAnError) {
  const testing::TemporaryDirectory directory;
  testing::TraceWriter writer(directory.path(), {.packet_size = 1 << 20});
  constexpr std::int64_t kEvents = 40'000;
  for (std::int64_t i = 0; i < kEvents; ++i) {
    writer.write(0, i, {1, 1, "a"}, ros2::RclTake{1});
  }
  writer.finish();
  const fs::path stream = directory.path() / "ros2_0";
  const std::uintmax_t size = fs::file_size(stream);
  ASSERT_GT(size, 3U << 19) << "two packets";

  TraceReader reader(directory.path(), TraceReader::Decoder::kDirect);
  std::int64_t events = 0;
  while (const TraceItem item = reader.next()) {
    ASSERT_EQ(item.event->timestamp_ns, events);
    if (events++ == 0) {
      fs::resize_file(stream, size / 2);
    }
  }
  EXPECT_GT(events, kEvents / 4);
  EXPECT_LT(events, kEvents / 4 * 3);
  ASSERT_EQ(reader.damage().size(), 2u) << "the first packet lost its end, the second one everything";
  const std::string problem = ": the file has become shorter meanwhile";
  EXPECT_EQ(reader.damage()[0], "'" + stream.string() + "', the packet at byte 0" + problem);
  EXPECT_TRUE(reader.damage()[1].ends_with(problem)) << reader.damage()[1];
  try {
    reader.throw_damage();
    FAIL() << "no TraceReadError";
  } catch (const TraceReadError& error) {
    EXPECT_EQ(error.what(), "the trace '" + directory.path().string() + "' is damaged or ends early: '" +
                                stream.string() + "', the packet at byte 0" + problem);
  }
}

TEST(DamagedTrace, AFileThatAnotherOneReplacesIsAnError) {
  const testing::TemporaryDirectory directory;
  for (const char* name : {"trace", "other"}) {
    testing::TraceWriter writer(directory.path() / name, {.packet_size = 1 << 20});
    for (std::int64_t i = 0; i < 20'000; ++i) {
      writer.write(0, i, {1, 1, "a"}, ros2::RclTake{1});
    }
    writer.finish();
  }
  TraceReader reader(directory.path() / "trace", TraceReader::Decoder::kDirect);
  ASSERT_TRUE(reader.next());
  fs::rename(directory.path() / "other/ros2_0", directory.path() / "trace/ros2_0");
  while (reader.next()) {
  }
  ASSERT_FALSE(reader.damage().empty());
  EXPECT_EQ(reader.damage()[0], "'" + (directory.path() / "trace/ros2_0").string() +
                                    "', the packet at byte 0: another file has taken the place of this file");
}

// A packet is read in parts. An event may be larger than such a part, and may lie across its end.
TEST(DamagedTrace, EventsOfAnySizeAreWholeInALargePacket) {
  const testing::TemporaryDirectory directory;
  testing::TraceWriter writer(directory.path(), {.packet_size = 4 << 20});
  const std::uint16_t id = writer.declare("a:text", "string _text; integer { size = 64; align = 8; } _number;");
  for (const std::size_t size : {10, 100'000, 100'000, 3'000, 5'000, 700'000, 1, 300'000, 0, 1'500'000}) {
    const std::uint64_t number = size;
    std::string payload(size, 'x');
    payload.push_back('\0');
    payload.append(reinterpret_cast<const char*>(&number), sizeof number);
    for (std::int64_t i = 0; i < 3; ++i) {
      writer.write_raw(0, 1, {1, 1, "a"}, id, payload);
    }
    for (std::int64_t i = 0; i < 2000; ++i) {
      writer.write(0, 1, {1, 1, "a"}, ros2::RclTake{size});
    }
  }
  writer.finish();
  const auto seen = testing::trace_text(directory.path(), TraceReader::Decoder::kDirect);
  EXPECT_EQ(seen.size(), 20'030u);
  EXPECT_TRUE(seen == testing::trace_text(directory.path(), TraceReader::Decoder::kBabeltrace));
}

ctf::FieldClassPtr array_of(ctf::FieldClassPtr element, std::uint64_t length) {
  ctf::FieldClass array;
  array.kind = ctf::FieldKind::kArray;
  array.element = std::move(element);
  array.length = length;
  return ctf::complete(std::move(array));
}

TEST(DamagedTrace, ACountAllocatesNoMoreFieldsThanThePacketCanHold) {
  ctf::FieldClass string;
  string.kind = ctf::FieldKind::kString;
  ctf::FieldClass structure;
  structure.kind = ctf::FieldKind::kStructure;
  structure.members = {{"text", ctf::complete(string)}};
  const ctf::FieldClassPtr element = ctf::complete(structure);
  structure.members.clear();
  const ctf::FieldClassPtr empty = ctf::complete(structure);
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

std::string refusal(const std::string& metadata) {
  try {
    ctf::parse_metadata(metadata);
  } catch (const ctf::UnsupportedTrace& refused) {
    return refused.what();
  }
  return "";
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) {
    result += text;
  }
  return result;
}

// Each of them would need more stack or time than there is.
TEST(DamagedTrace, MetadataOfTooManyTypesAreRefused) {
  const std::string too_deep = "metadata, line 1: more than 64 types inside one another";
  EXPECT_EQ(refusal(repeated("struct { ", 100'000)), too_deep);
  EXPECT_EQ(refusal(repeated("enum : ", 100'000)), too_deep);
  EXPECT_EQ(refusal(repeated("integer { a := ", 100'000)), too_deep);
  EXPECT_EQ(refusal("struct { integer { size = 8; } x" + repeated("[1]", 100'000) + "; };"), too_deep);
  std::string chain = "struct s0 { };";
  std::string doubled = chain;
  for (int i = 1; i < 100; ++i) {
    chain += fmt::format("struct s{} {{ struct s{} a; }};", i, i - 1);
    doubled += fmt::format("struct s{} {{ struct s{} a; struct s{} b; }};", i, i - 1, i - 1);
  }
  EXPECT_EQ(refusal(chain), too_deep);
  EXPECT_EQ(refusal(doubled), "metadata, line 1: a type with more than 65536 fields");
  EXPECT_EQ(refusal(repeated("struct s { ", 50) + repeated("}; ", 50)),
            "metadata, line 1: expected the name of a "
            "field, found ';'");
}

TEST(DamagedTrace, HeadersContextsAndFieldsMustBeStructures) {
  for (const std::string what : {"event.header", "event.context", "packet.context"}) {
    EXPECT_EQ(refusal("stream { " + what + " := string; };"), "metadata, line 1: '" + what + "' is no structure");
  }
  EXPECT_EQ(refusal("stream { packet.context := variant <a.b> { string x; string y; }; };"),
            "metadata, line 1: 'packet.context' is no structure");
  EXPECT_EQ(refusal("trace { packet.header := string; };"), "metadata, line 1: 'packet.header' is no structure");
  EXPECT_EQ(refusal("event { fields := string; };"), "metadata, line 1: 'fields' is no structure");
  EXPECT_EQ(refusal("event { context = 3; };"), "metadata, line 1: 'context' is no structure");
}

}  // namespace
}  // namespace tracing
