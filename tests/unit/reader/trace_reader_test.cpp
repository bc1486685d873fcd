// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/trace_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tests/unit/reader/recording_sink.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using testing::RecordingSink;
using testing::TemporaryDirectory;
using testing::Thread;
using testing::TraceWriter;

constexpr Thread kPing{71, 71, "ping"};
constexpr Thread kPong{72, 720, "pong"};

std::vector<std::int64_t> times(const RecordingSink& sink) {
  std::vector<std::int64_t> result;
  for (const auto& event : sink.events) {
    result.push_back(event.timestamp_ns);
  }
  return result;
}

RecordingSink read(const fs::path& directory) {
  RecordingSink sink;
  TraceReader(directory).read(sink);
  return sink;
}

TraceReadError error_of(const fs::path& directory, RecordingSink& sink) {
  try {
    TraceReader(directory).read(sink);
  } catch (const TraceReadError& error) {
    return error;
  }
  ADD_FAILURE() << "no TraceReadError for " << directory;
  return TraceReadError("", "");
}

TEST(TraceReader, GivesTheEventsOfAllCpusInTheOrderOfTime) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  writer.write(0, 1000, kPing, ros2::CallbackStart{1, false});
  writer.write(0, 3000, kPing, ros2::CallbackEnd{1});
  writer.write(1, 2000, kPong, ros2::RclTake{5});
  writer.write(1, 4000, kPong, ros2::RclTake{6});
  writer.finish();

  const RecordingSink sink = read(directory.path());

  EXPECT_THAT(times(sink), ElementsAre(1000, 2000, 3000, 4000));
  EXPECT_TRUE(sink.losses.empty());
  EXPECT_EQ(sink.events[0].name, "ros2:callback_start");
  EXPECT_EQ(sink.events[1].name, "ros2:rcl_take");
  EXPECT_EQ(sink.events[1].cpu_id, 1);
  EXPECT_EQ(sink.events[1].vpid, 72);
  EXPECT_EQ(sink.events[1].vtid, 720);
  EXPECT_EQ(sink.events[1].procname, "pong");
}

TEST(TraceReader, GivesFieldsByNameAndByIndex) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  writer.write(0, 1, kPing, ros2::RclNodeInit{0xffff800000000001, 2, "ping", "/ns"});
  writer.finish();

  RecordingSink sink;
  sink.also = [](const Event& event) {
    EXPECT_THAT(event.event_class->fields, ElementsAre("node_handle", "rmw_handle", "node_name", "namespace"));
    EXPECT_EQ(event.field(0).unsigned_integer(), 0xffff800000000001);
    EXPECT_EQ(event.field(0).integer(), std::nullopt) << "does not fit";
    EXPECT_EQ(event.field("rmw_handle")->integer(), 2);
    EXPECT_EQ(event.field("node_name")->string(), "ping");
    EXPECT_EQ(event.field("node_name")->unsigned_integer(), std::nullopt);
    EXPECT_EQ(event.field("node_name")->size(), 0u);
    EXPECT_FALSE(event.field("gid").has_value());
  };
  TraceReader(directory.path()).read(sink);
  EXPECT_EQ(sink.events.size(), 1u);
}

TEST(TraceReader, SaysWhenContextsWereNotRecorded) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path(), {.contexts = false});
  writer.write(0, 1, kPing, ros2::RclTake{5});
  writer.finish();

  const RecordingSink sink = read(directory.path());

  ASSERT_EQ(sink.events.size(), 1u);
  EXPECT_EQ(sink.events[0].vpid, std::nullopt);
  EXPECT_EQ(sink.events[0].vtid, std::nullopt);
  EXPECT_EQ(sink.events[0].procname, std::nullopt);
  EXPECT_EQ(sink.events[0].cpu_id, 0);
}

TEST(TraceReader, ReportsDiscardedEventsWithStreamTimeAndCount) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  writer.write(0, 100, kPing, ros2::RclTake{5});
  writer.end_packet(0);
  writer.discard_events(0, 37);
  writer.write(0, 200, kPing, ros2::RclTake{6});
  writer.write(0, 300, kPing, ros2::RclTake{7});
  writer.end_packet(0);
  writer.write(1, 400, kPing, ros2::RclTake{8});
  writer.finish();

  const RecordingSink sink = read(directory.path());

  EXPECT_EQ(sink.events.size(), 4u);
  ASSERT_EQ(sink.losses.size(), 1u);
  EXPECT_EQ(sink.losses[0].kind, Loss::Kind::kEvents);
  EXPECT_EQ(sink.losses[0].stream, "ros2_0");
  EXPECT_EQ(sink.losses[0].count, 37u);
  EXPECT_EQ(sink.losses[0].begin_ns, 100);
  EXPECT_EQ(sink.losses[0].end_ns, 300);
}

// Under overload LTTng now and then writes 0 as the total of a packet. What comes after it is not lost a second time.
TEST(TraceReader, CountsAClimbBackToATotalAsNoLoss) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  writer.write(0, 100, kPing, ros2::RclTake{5});
  writer.end_packet(0);
  writer.discard_events(0, 37);
  writer.write(0, 200, kPing, ros2::RclTake{6});
  writer.end_packet(0);
  writer.hide_discarded_events(0);
  writer.write(0, 300, kPing, ros2::RclTake{7});
  writer.end_packet(0);
  writer.discard_events(0, 3);
  writer.write(0, 400, kPing, ros2::RclTake{8});
  writer.finish();

  const RecordingSink sink = read(directory.path());

  ASSERT_EQ(sink.losses.size(), 2u);
  EXPECT_EQ(sink.losses[0].count, 37u);
  EXPECT_EQ(sink.losses[1].count, 3u);
}

// The count in a packet is a running total: it is not known how much of the first packet's count belongs to this trace.
TEST(TraceReader, ReportsALossWithoutCountInAStreamsFirstPacket) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  writer.discard_events(0, 5);
  writer.write(0, 200, kPing, ros2::RclTake{6});
  writer.finish();

  const RecordingSink sink = read(directory.path());

  ASSERT_EQ(sink.losses.size(), 1u);
  EXPECT_EQ(sink.losses[0].kind, Loss::Kind::kEvents);
  EXPECT_EQ(sink.losses[0].count, std::nullopt);
}

TEST(TraceReader, ReportsPacketsThatWereOverwritten) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path(), {.per_process_vpid = 71});
  writer.write(0, 100, kPing, ros2::RclTake{5});
  writer.end_packet(0);
  writer.lose_packets(0, 3);
  writer.write(0, 200, kPing, ros2::RclTake{6});
  writer.finish();

  const RecordingSink sink = read(directory.path());

  EXPECT_EQ(sink.events.size(), 2u);
  ASSERT_EQ(sink.losses.size(), 1u);
  EXPECT_EQ(sink.losses[0].kind, Loss::Kind::kPackets);
  EXPECT_EQ(sink.losses[0].count, 3u);
  EXPECT_EQ(sink.losses[0].vpid, 71) << "of the process whose buffers these were";
}

TEST(TraceReader, MergesAllTracesBelowTheDirectory) {
  const TemporaryDirectory directory;
  TraceWriter snapshot(directory.path() / "snapshot/ust/uid/0/64-bit", {.identity = 1});
  snapshot.write(0, 1000, kPing, ros2::RclInit{1, "8.10.1"});
  snapshot.write(0, 3000, kPing, ros2::RclInit{2, "8.10.1"});
  snapshot.finish();
  TraceWriter runtime(directory.path() / "runtime/ust/uid/0/64-bit", {.identity = 2});
  runtime.write(0, 2000, kPing, ros2::RclTake{5});
  runtime.finish();

  const RecordingSink sink = read(directory.path());

  EXPECT_THAT(times(sink), ElementsAre(1000, 2000, 3000));
  EXPECT_EQ(sink.events[0].trace, sink.events[2].trace);
  EXPECT_NE(sink.events[0].trace, sink.events[1].trace);
}

TEST(TraceReader, JoinsTheChunksOfARotatedTrace) {
  const TemporaryDirectory directory;
  for (const int chunk : {0, 1}) {
    TraceWriter writer(directory.path() / std::to_string(chunk), {.identity = 1});
    writer.write(0, 1000 * (chunk + 1), kPing, ros2::RclTake{5});
    writer.finish();
  }

  const RecordingSink sink = read(directory.path());

  EXPECT_THAT(times(sink), ElementsAre(1000, 2000));
  EXPECT_EQ(sink.events[0].trace, sink.events[1].trace);
}

TEST(TraceReader, ReadsATraceInWhichNothingHappened) {
  const TemporaryDirectory directory;
  TraceWriter(directory.path()).finish();
  EXPECT_TRUE(read(directory.path()).events.empty());
}

TEST(TraceReader, SaysThatADirectoryDoesNotExist) {
  RecordingSink sink;
  const TraceReadError error = error_of("/nonexistent/trace", sink);
  EXPECT_STREQ(error.what(), "cannot read the trace '/nonexistent/trace': no such directory");
  EXPECT_EQ(error.remedy(), "give the directory that the launcher printed when it ended the session");
}

TEST(TraceReader, SaysThatADirectoryIsNoTrace) {
  const TemporaryDirectory directory;
  fs::create_directories(directory.path() / "ust/uid");
  RecordingSink sink;
  const TraceReadError error = error_of(directory.path(), sink);
  EXPECT_EQ(error.what(), "'" + directory.path().string() +
                              "' is not a trace: neither it nor a directory below it has a file 'metadata'");
  EXPECT_EQ(error.remedy(),
            "LTTng writes no trace when no traced process ran during the session, and none before 'snapshot record'");
}

TEST(TraceReader, SaysThatAFileIsNoTrace) {
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "file") << "text";
  RecordingSink sink;
  const TraceReadError error = error_of(directory.path() / "file", sink);
  EXPECT_EQ(error.what(), "cannot read the trace '" + (directory.path() / "file").string() + "': not a directory");
}

TEST(TraceReader, NamesTheTraceWhoseMetadataAreDamaged) {
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "metadata") << "/* CTF 1.8 */ trace { major = 2; minor = 0; byte_order = le; };";
  ::testing::internal::CaptureStderr();
  RecordingSink sink;
  const TraceReadError error = error_of(directory.path(), sink);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(error.what(), "cannot read the trace '" + directory.path().string() + "': metadata, line 1: not CTF 1.8");
  EXPECT_EQ(error.remedy(),
            "its metadata are damaged or not those of CTF 1.8; a full disk or a killed session daemon cuts them");
  EXPECT_NE(error.details(), "");
}

TEST(TraceReader, SaysWhenItDoesNotKnowSomethingOfCtf2) {
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "metadata") << "\x1e"
                                                  R"({"type": "preamble", "version": 3})";
  RecordingSink sink;
  EXPECT_EQ(error_of(directory.path(), sink).remedy(),
            "it is a trace of CTF 2 with something that this reader does not know; babeltrace2 from version 2.1 on "
            "converts it");
}

TEST(TraceReader, NamesTheStreamFileThatIsTruncated) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  writer.write(0, 100, kPing, ros2::RclTake{5});
  writer.finish();
  const fs::path stream = directory.path() / "ros2_0";
  fs::resize_file(stream, fs::file_size(stream) - 10);

  ::testing::internal::CaptureStderr();
  RecordingSink sink;
  const TraceReadError error = error_of(directory.path(), sink);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(error.what(), "the trace '" + directory.path().string() + "' is damaged or ends early: '" +
                              stream.string() + "', the packet at byte 0 ends behind the end of the file");
}

TEST(TraceReader, GivesTheEventsBeforeDamagedData) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  for (int i = 0; i < 100; ++i) {
    writer.write(0, 100 + i, kPing, ros2::RclTake{5});
  }
  constexpr std::uint16_t kUndeclared = 999;
  writer.write_raw(0, 300, kPing, kUndeclared, "");
  writer.finish();

  ::testing::internal::CaptureStderr();
  RecordingSink sink;
  const TraceReadError error = error_of(directory.path(), sink);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(error.what(),
              ::testing::StartsWith("the trace '" + directory.path().string() + "' is damaged or ends early: "));
  EXPECT_EQ(error.remedy(), "what can be read beside the damage was read");
  EXPECT_EQ(sink.events.size(), 100u);
}

// A program has the file open for writing, and the end of its last packet is not there yet.
TEST(TraceReader, GivesTheWholePacketsOfATraceThatIsStillBeingWritten) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  writer.write(0, 100, kPing, ros2::RclTake{5});
  writer.end_packet(0);
  writer.write(0, 200, kPing, ros2::RclTake{6});
  writer.finish();
  const fs::path stream = directory.path() / "ros2_0";
  const std::uintmax_t size = fs::file_size(stream);
  for (const std::uintmax_t missing : {std::uintmax_t{3}, size / 2 - 20}) {
    fs::resize_file(stream, size - missing);
    std::ofstream writing(stream, std::ios::binary | std::ios::app);
    for (const auto decoder : {TraceReader::Decoder::kDirect, TraceReader::Decoder::kAny}) {
      TraceReader reader(directory.path(), decoder);
      EXPECT_THAT(reader.open_directories(), ElementsAre(directory.path()));
      ASSERT_TRUE(reader.next());
      EXPECT_FALSE(reader.next());
      EXPECT_TRUE(reader.damage().empty()) << reader.damage()[0];
    }
    writing.close();
    TraceReader reader(directory.path());
    EXPECT_TRUE(reader.open_directories().empty());
    while (reader.next()) {
    }
    EXPECT_FALSE(reader.damage().empty());
  }
}

// LTTng writes the metadata in parts, and some only after the events.
TEST(TraceReader, ReadsAnOpenTraceAsFarAsItsMetadataGo) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  writer.write(0, 100, kPing, ros2::RclTake{5});
  writer.end_packet(0);
  writer.write(0, 200, kPing, ros2::CallbackEnd{6});
  writer.finish();
  std::string metadata;
  std::getline(std::ifstream(directory.path() / "metadata"), metadata, '\0');
  const std::ofstream writing(directory.path() / "ros2_0", std::ios::binary | std::ios::app);
  const std::size_t second = metadata.rfind("event {");
  for (const auto& [size, events] : std::vector<std::pair<std::size_t, std::size_t>>{
           {metadata.size(), 2}, {second + 40, 1}, {second, 1}, {metadata.find("event {"), 0}, {20, 0}, {0, 0}}) {
    std::ofstream(directory.path() / "metadata") << metadata.substr(0, size);
    TraceReader reader(directory.path());
    std::size_t seen = 0;
    while (reader.next()) {
      ++seen;
    }
    EXPECT_EQ(seen, events) << size;
    EXPECT_TRUE(reader.damage().empty()) << size;
    EXPECT_EQ(reader.lacks_descriptions(), events < 2) << size;
  }
}

TEST(TraceReader, DescribesTheTraces) {
  const TemporaryDirectory directory;
  for (const int chunk : {0, 1}) {
    TraceWriter writer(directory.path() / std::to_string(chunk), {.per_process_vpid = 71, .identity = 3});
    writer.write(0, 1000 * (chunk + 1), kPing, ros2::RclTake{5});
    writer.finish();
  }
  for (const auto decoder : {TraceReader::Decoder::kDirect, TraceReader::Decoder::kBabeltrace}) {
    TraceReader reader(directory.path(), decoder);
    ASSERT_TRUE(reader.next());
    ASSERT_EQ(reader.traces().size(), 1u);
    const TraceDescription& trace = reader.traces()[0];
    EXPECT_EQ(trace.uuid, "11111111-1111-1111-1111-111111111103");
    EXPECT_EQ(trace.directories.at(0), directory.path() / "0");
    EXPECT_EQ(trace.environment.at("domain"), ctf::EnvironmentValue("ust"));
    EXPECT_EQ(trace.environment.at("vpid"), ctf::EnvironmentValue(std::int64_t{71}));
  }
}

TEST(TraceReader, LetsAnExceptionOfTheSinkPass) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  writer.write(0, 1, kPing, ros2::RclTake{5});
  writer.write(0, 2, kPing, ros2::RclTake{5});
  writer.finish();
  RecordingSink sink;
  sink.also = [](const Event&) { throw std::runtime_error("enough"); };
  try {
    TraceReader(directory.path()).read(sink);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "enough");
  }
  EXPECT_EQ(sink.events.size(), 1u);
}

}  // namespace
}  // namespace tracing
