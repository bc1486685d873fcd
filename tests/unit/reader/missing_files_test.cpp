// SPDX-License-Identifier: Apache-2.0
// Files of a trace that were cut at the border of a packet, or are gone: their index tells.
#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tests/unit/reader/recording_sink.hpp"
#include "tracing/decode/ctf/metadata_text.hpp"
#include "tracing/decode/ctf/packet.hpp"
#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::TraceWriter;

constexpr testing::Thread kTalker{71, 71, "talker"};

std::string big_endian(std::uint64_t number, int bytes) {
  std::string text;
  for (int byte = bytes - 1; byte >= 0; --byte) {
    text += static_cast<char>(number >> (8 * byte));
  }
  return text;
}

// Two streams of two packets, each with one event, and their index as LTTng writes it.
class MissingFiles : public ::testing::Test {
 protected:
  MissingFiles() { write_trace(trace_); }

  static void write_trace(const fs::path& trace) {
    TraceWriter writer(trace);
    for (const unsigned cpu : {0u, 1u}) {
      writer.write(cpu, 100 + cpu, kTalker, ros2::RclTake{5});
      writer.end_packet(cpu);
      writer.write(cpu, 200 + cpu, kTalker, ros2::RclTake{6});
    }
    writer.finish();
    fs::create_directory(trace / "index");
    const ctf::TraceClass declarations = ctf::parse_metadata(ctf::read_metadata(trace / "metadata"));
    for (const char* name : {"ros2_0", "ros2_1"}) {
      const ctf::StreamFile file(trace / name);
      std::ofstream index(trace / "index" / (std::string(name) + ".idx"), std::ios::binary);
      index << big_endian(0xc1f1dcc1, 4) << big_endian(1, 4) << big_endian(1, 4) << big_endian(72, 4);
      for (const ctf::Packet& packet : find_packets(declarations, file).packets) {
        index << big_endian(packet.offset, 8) << big_endian(packet.size_bits, 8) << std::string(72 - 16, '\0');
      }
    }
  }

  // The damage that is known before the first event; the end of the reading must throw it.
  std::vector<std::string> damage(const fs::path& directory) const {
    TraceReader reader(directory);
    std::vector<std::string> lines = reader.damage();
    testing::RecordingSink sink;
    if (lines.empty()) {
      reader.read(sink);
    } else {
      EXPECT_THROW(reader.read(sink), TraceReadError);
    }
    return lines;
  }

  testing::TemporaryDirectory directory_;
  fs::path trace_ = directory_.path() / "ust";
  std::string stream_ = (trace_ / "ros2_1").string();
};

TEST_F(MissingFiles, AreNotTold) {
  EXPECT_THAT(damage(directory_.path()), IsEmpty());
}

TEST_F(MissingFiles, AStreamThatEndsAtTheBorderOfAPacket) {
  const ctf::StreamFile file(stream_);
  const auto packets = find_packets(ctf::parse_metadata(ctf::read_metadata(trace_ / "metadata")), file).packets;
  ASSERT_EQ(packets.size(), 2u);
  fs::resize_file(stream_, packets[1].offset);
  EXPECT_THAT(damage(directory_.path()), ElementsAre("'" + stream_ + "' ends early, without 1 of 2 packets"));
}

TEST_F(MissingFiles, AnEmptyStream) {
  fs::resize_file(stream_, 0);
  EXPECT_THAT(damage(directory_.path()), ElementsAre("'" + stream_ + "' ends early, without 2 of 2 packets"));
}

TEST_F(MissingFiles, AStreamThatHasMoreThanItsIndex) {
  std::ofstream(stream_, std::ios::binary | std::ios::app) << std::string(4096, '\0');
  EXPECT_THAT(damage(directory_.path()),
              Contains("'" + stream_ + "' is longer than its 2 packets: it was changed since"));
}

TEST_F(MissingFiles, AStreamThatIsGone) {
  fs::remove(stream_);
  EXPECT_THAT(damage(directory_.path()), ElementsAre("'" + stream_ + "' is missing, with 2 packets"));
}

TEST_F(MissingFiles, AFolderInThePlaceOfAStream) {
  fs::remove(stream_);
  fs::create_directory(stream_);
  EXPECT_THAT(damage(directory_.path()), ElementsAre("'" + stream_ + "' is no file; it should hold 2 packets"));
}

TEST_F(MissingFiles, TheMetadataOfOneHalf) {
  const fs::path kernel = directory_.path() / "kernel";
  write_trace(kernel);
  EXPECT_THAT(damage(directory_.path()), IsEmpty());
  fs::remove(kernel / "metadata");
  EXPECT_THAT(damage(directory_.path()),
              ElementsAre("'" + (kernel / "metadata").string() +
                          "' is missing, without which the 2 stream files of the directory can't be read"));
}

TEST_F(MissingFiles, APacketThatIsGoneWithItsIndex) {
  const auto verdict = [this](const std::string& bytes, const std::string& more = "") {
    std::ofstream(directory_.path() / "verdict.json")
        << R"({"channels": [{"domain": "ust", "counted_by": "packets", "bytes": )" << bytes
        << R"(}, {"domain": "ust", "counted_by": "daemon", "bytes": 9999999}])" << more << "}";
  };
  testing::RecordingSink sink;
  verdict("1");
  TraceReader(directory_.path()).read(sink);
  verdict("9999999");
  EXPECT_THROW(TraceReader(directory_.path()).read(sink), TraceReadError);
  verdict("9999999", R"(, "reasons": ["it does not know"])");
  TraceReader(directory_.path()).read(sink);
  verdict("1", R"(, "reasons": ["a signal"], "bytes": {"ust": 9999999})");
  EXPECT_THROW(TraceReader(directory_.path()).read(sink), TraceReadError);
  std::ofstream(directory_.path() / "verdict.json") << "{";
  EXPECT_THAT(damage(directory_.path()), ElementsAre("'" + (directory_.path() / "verdict.json").string() +
                                                     "' is broken, so nothing tells what else is missing"));
}

// Each verdict is held against what lies below it, whichever directory the user names.
TEST_F(MissingFiles, OfOneOfTwoRecordings) {
  const fs::path both = directory_.path() / "both";
  for (const char* name : {"first", "second"}) {
    write_trace(both / name / "ust");
    fs::remove_all(both / name / "ust" / "index");
    TraceReader reader(both / name);
    reader.next();
    std::ofstream(both / name / "verdict.json")
        << R"({"channels": [{"domain": "ust", "counted_by": "packets", "bytes": )" << reader.content_bytes().value_or(0)
        << "}]}";
  }
  testing::RecordingSink sink;
  TraceReader(both).read(sink);
  TraceReader({both / "first", both / "second"}).read(sink);
  fs::remove(both / "second" / "ust" / "ros2_1");
  for (const std::vector<fs::path>& directories : {std::vector{both}, {both / "first", both / "second"}}) {
    TraceReader reader(directories);
    EXPECT_THROW(reader.read(sink), TraceReadError);
    ASSERT_EQ(reader.damage().size(), 1u);
    EXPECT_THAT(reader.damage().front(), ::testing::StartsWith("'" + (both / "second").string() + "' lacks "));
  }
}

TEST_F(MissingFiles, OfTheMetadataOfTheOnlyTrace) {
  fs::remove(trace_ / "metadata");
  try {
    TraceReader reader(directory_.path());
    FAIL() << "nothing was thrown";
  } catch (const TraceReadError& error) {
    EXPECT_EQ(error.what(),
              "cannot read the trace '" + directory_.path().string() + "': '" + trace_.string() +
                  "/metadata' is missing, without which the 2 stream files of the directory can't be read");
    EXPECT_EQ(error.remedy(), "no other file tells what the streams hold; copy the trace again with all of its files");
  }
}

TEST_F(MissingFiles, AnIndexThatIsNoneTellsNothing) {
  std::ofstream(trace_ / "index" / "ros2_1.idx") << "something else, but long enough";
  EXPECT_THAT(damage(directory_.path()), IsEmpty());
}

}  // namespace
}  // namespace tracing
