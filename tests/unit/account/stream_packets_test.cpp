// SPDX-License-Identifier: Apache-2.0
// The packets of recordings as LTTng lays them out in directories.
#include "tracing/record/account/stream_packets.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"

namespace {

namespace fs = std::filesystem;
using tracing::Stream;
using tracing::testing::Thread;
using tracing::testing::TraceWriter;

struct StreamPackets : testing::Test {
  // A stream of one processor, with so many packets before these.
  static void write(const fs::path& directory, std::uint64_t earlier, int packets) {
    TraceWriter writer(directory);
    writer.lose_packets(0, earlier);
    for (int i = 0; i < packets; ++i) {
      const auto time = static_cast<std::int64_t>(100 * (earlier + 1) + static_cast<std::uint64_t>(i));
      writer.write(0, time, Thread{.vpid = 1, .vtid = 1, .procname = "a"}, tracing::ros2::RclTake{1});
      writer.end_packet(0);
    }
    writer.finish();
  }

  test_support::Sandbox sandbox;
  fs::path run = sandbox.directory() / "run";
};

TEST_F(StreamPackets, OfArchivesBelongToOneStream) {
  write(run / "archives/b-1/ust/uid/0/64-bit", 2, 1);
  write(run / "archives/a-0/ust/uid/0/64-bit", 0, 2);
  const std::vector<Stream> streams = tracing::read_streams(run);
  ASSERT_EQ(streams.size(), 1u);
  EXPECT_EQ(streams[0].cpu, "0");
  ASSERT_EQ(streams[0].packets.size(), 3u);
  EXPECT_EQ(streams[0].packets[0].sequence_number, 0u);
  EXPECT_EQ(streams[0].packets[2].sequence_number, 2u);
  EXPECT_EQ(tracing::first_time(streams), 100u);
}

// A rotation never ends where a process has died within an event.
TEST_F(StreamPackets, OfARotationThatHasNotEndedBelongToOneStream) {
  write(run / ".tmp_old_chunk/ust/uid/0/64-bit", 0, 2);
  write(run / "20261122T190204+0000-1/ust/uid/0/64-bit", 2, 1);
  write(run / "appended-1/ust/uid/0/64-bit", 0, 7);
  const std::vector<Stream> streams = tracing::read_streams(run);
  ASSERT_EQ(streams.size(), 1u);
  EXPECT_EQ(streams[0].packets.size(), 3u);
}

TEST_F(StreamPackets, OfNumberedFilesBelongToOneStream) {
  const fs::path trace = run / "ust/uid/0/64-bit";
  write(trace, 3, 2);
  const std::string channel = tracing::read_streams(run).at(0).channel;
  fs::rename(trace / (channel + "_0"), trace / (channel + "_0_0"));
  write(run / "other", 1, 2);
  fs::rename(run / "other" / (channel + "_0"), trace / (channel + "_0_1"));
  const std::vector<Stream> streams = tracing::read_streams(run, {channel});
  ASSERT_EQ(streams.size(), 1u);
  EXPECT_EQ(streams[0].channel, channel);
  EXPECT_EQ(streams[0].cpu, "0");
  EXPECT_EQ(streams[0].packets.size(), 4u);
  EXPECT_EQ(streams[0].packets[0].sequence_number, 1u) << "the later file was overwritten";
  const std::vector<Stream> of_another_name = tracing::read_streams(run);
  ASSERT_EQ(of_another_name.size(), 2u) << "without a limit the number is that of a processor";
  EXPECT_EQ(of_another_name[1].channel, channel + "_0");
}

TEST_F(StreamPackets, OfAChannelWithADotInItsName) {
  const fs::path trace = run / "ust/uid/0/64-bit";
  write(trace, 0, 1);
  fs::rename(trace / (tracing::read_streams(run).at(0).channel + "_0"), trace / "nav.fast_0");
  const std::vector<Stream> streams = tracing::read_streams(run);
  ASSERT_EQ(streams.size(), 1u);
  EXPECT_EQ(streams[0].channel, "nav.fast");
  EXPECT_EQ(streams[0].packets.size(), 1u);
}

TEST_F(StreamPackets, KnowTheProcessThatOwnsTheBuffers) {
  write(run / "ust/pid/talker-1-47-20261122-190204", 0, 1);
  write(run / "ust/pid/short/64-bit", 0, 1);
  const std::vector<Stream> streams = tracing::read_streams(run);
  ASSERT_EQ(streams.size(), 2u);
  EXPECT_EQ(streams[0].pid, std::nullopt);
  EXPECT_EQ(streams[1].pid, 47);
}

TEST_F(StreamPackets, OfFilesThatCannotBeReadAreNone) {
  fs::create_directories(run / "ust/uid/0/64-bit/index");
  test_support::write_file(run / "ust/uid/0/64-bit/ros2_0", "no packet at all");
  test_support::write_file(run / "ust/uid/0/64-bit/index/ros2_0.idx", "no index");
  test_support::write_file(run / "ust/uid/0/64-bit/metadata", "/* CTF 1.8 */ half of a");
  const std::vector<Stream> streams = tracing::read_streams(run);
  ASSERT_EQ(streams.size(), 1u);
  EXPECT_EQ(streams[0].channel, "ros2");
  EXPECT_TRUE(streams[0].packets.empty());
}

TEST_F(StreamPackets, AreReadUntilTheUserGivesUp) {
  write(run / "ust/uid/0/64-bit", 0, 5);
  int asked = 0;
  const std::vector<Stream> streams = tracing::read_streams(run, {}, [&asked] { return ++asked > 3; });
  EXPECT_EQ(streams.at(0).packets.size(), 3u);
}

// An index of LTTng: big endian, a header of 16 bytes, then entries with the end of a packet as fifth number.
void write_index(const fs::path& file, const std::vector<unsigned char>& ends) {
  std::string index("\xC1\xF1\xDC\xC1\0\0\0\1\0\0\0\1\0\0\0\x48", 16);
  for (const unsigned char end : ends) {
    std::string entry(72, '\0');
    entry[39] = static_cast<char>(end);
    index += entry;
  }
  fs::create_directories(file.parent_path());
  test_support::write_file(file, index);
}

TEST_F(StreamPackets, HaveTheirLastTimesInIndexFiles) {
  write_index(run / "ust/uid/0/64-bit/index/ros2_0.idx", {3, 9});
  write_index(run / "ust/uid/0/64-bit/index/ros2_1.idx", {});
  write_index(run / "ust/pid/talker-47-20261122-190204/index/ros2_0.idx", {1});
  EXPECT_EQ(tracing::last_times(run, {}), (std::vector<std::uint64_t>{9, 0}));
  write_index(run / "ust/uid/0/64-bit/index/ros2_1_0.idx", {4});
  write_index(run / "ust/uid/0/64-bit/index/ros2_1_1.idx", {7, 8});
  fs::remove(run / "ust/uid/0/64-bit/index/ros2_1.idx");
  fs::remove(run / "ust/uid/0/64-bit/index/ros2_0.idx");
  EXPECT_EQ(tracing::last_times(run, {"ros2"}), std::vector<std::uint64_t>{8});
}

TEST_F(StreamPackets, ThatAreThereInPartAreLeftOut) {
  write(run / "ust/uid/0/64-bit", 0, 2);
  const fs::path file = run / "ust/uid/0/64-bit" / (tracing::read_streams(run).at(0).channel + "_0");
  fs::resize_file(file, fs::file_size(file) - 1);
  EXPECT_EQ(tracing::read_streams(run).at(0).packets.size(), 1u);
}

}  // namespace
