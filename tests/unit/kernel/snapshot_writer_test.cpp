// SPDX-License-Identifier: Apache-2.0
// Snapshots that overlap, as the readers of traces see them.
#include "tracing/record/kernel/snapshot_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "tests/support/sandbox.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using tracing::TraceReader;
using tracing::kernel::EventFormat;
using tracing::kernel::PageHistory;
using tracing::kernel::parse_event_format;
using tracing::kernel::SnapshotWriter;
using tracing::kernel::ThreadTable;
using tracing::kernel::TraceClock;

constexpr std::uint64_t kOverwritten = std::uint64_t{1} << 31;
// No kernel gives such a high number, so /proc has nothing about it.
constexpr std::int32_t kTalker = 0x7f000001;

EventFormat event(const char* name, int id, const char* fields) {
  return parse_event_format("name: " + std::string(name) + "\nID: " + std::to_string(id) + "\n" + fields);
}

EventFormat tick() {
  return event("tick", 7, "\tfield:int value;\toffset:8;\tsize:4;\tsigned:1;\n");
}

ThreadTable no_threads() {
  return {event("task_newtask", 205,
                "\tfield:pid_t pid;\toffset:8;\tsize:4;\tsigned:1;\n"
                "\tfield:char comm[16];\toffset:12;\tsize:16;\tsigned:0;\n"
                "\tfield:u64 clone_flags;\toffset:32;\tsize:8;\tsigned:0;\n"),
          event("task_rename", 204,
                "\tfield:pid_t pid;\toffset:8;\tsize:4;\tsigned:1;\n"
                "\tfield:char oldcomm[16];\toffset:12;\tsize:16;\tsigned:0;\n"
                "\tfield:char newcomm[16];\toffset:28;\tsize:16;\tsigned:0;\n")};
}

// A page with one record at `time`.
PageHistory::Page page_of(std::uint64_t time, const std::vector<std::uint8_t>& record, std::uint64_t flags) {
  PageHistory::Page page(4096);
  const std::uint64_t commit = (4 + record.size()) | flags;
  const auto header = static_cast<std::uint32_t>(record.size() / 4);  // the type is the length in words
  std::memcpy(page.data(), &time, sizeof time);
  std::memcpy(page.data() + 8, &commit, sizeof commit);
  std::memcpy(page.data() + 16, &header, sizeof header);
  std::memcpy(page.data() + 20, record.data(), record.size());
  return page;
}

PageHistory::Page tick_page(std::uint64_t time, std::int32_t value, std::uint64_t flags = 0) {
  std::vector<std::uint8_t> record(12);
  const std::uint16_t id = 7;
  std::memcpy(record.data(), &id, sizeof id);
  std::memcpy(record.data() + 4, &kTalker, sizeof kTalker);
  std::memcpy(record.data() + 8, &value, sizeof value);
  return page_of(time, record, flags);
}

// Begins the thread.
PageHistory::Page newtask_page(std::uint64_t time, const char* name) {
  std::vector<std::uint8_t> record(40);
  const std::uint16_t id = 205;
  std::memcpy(record.data(), &id, sizeof id);
  std::memcpy(record.data() + 8, &kTalker, sizeof kTalker);
  std::memcpy(record.data() + 12, name, std::strlen(name));
  return page_of(time, record, 0);
}

struct SnapshotWriterTest : testing::Test {
  void write_snapshot(const std::string& name) {
    const fs::path directory = sandbox.directory() / "run" / name / "kernel";
    fs::create_directories(directory);
    writer.write(directory, clock);
  }

  // "1" for an event with this value, "lost 2" for two lost packets.
  std::vector<std::string> read(const fs::path& path, TraceReader::Decoder decoder = TraceReader::Decoder::kDirect) {
    std::vector<std::string> items;
    TraceReader reader(sandbox.directory() / path, decoder);
    for (tracing::TraceItem item = reader.next(); item; item = reader.next()) {
      if (item.loss != nullptr) {
        items.push_back("lost " + std::to_string(item.loss->count.value_or(0)));
      } else {
        items.push_back(std::to_string(item.event->field("value")->integer().value_or(-1)) +
                        std::string(item.event->procname.value_or("")));
      }
    }
    reader.throw_damage();
    return items;
  }

  test_support::Sandbox sandbox;
  TraceClock clock{.uuid = "11111111-1111-1111-1111-111111111111", .offset = 1'000'000'000'000};
  SnapshotWriter writer{1 << 20, {tick()}, {"procname"}, no_threads()};
};

TEST_F(SnapshotWriterTest, WhatIsInTwoSnapshotsIsReadOnce) {
  writer.add(0, tick_page(100, 1));
  writer.add(1, tick_page(150, 2));
  write_snapshot("snapshot-1");
  writer.add(0, tick_page(200, 3));
  write_snapshot("snapshot-2");
  EXPECT_THAT(read("run/snapshot-1"), ElementsAre("1", "2"));
  EXPECT_THAT(read("run/snapshot-2"), ElementsAre("1", "2", "3"));
  EXPECT_THAT(read("run"), ElementsAre("1", "2", "3"));
  EXPECT_THAT(read("run", TraceReader::Decoder::kBabeltrace), ElementsAre("1", "2", "3"));
}

TEST_F(SnapshotWriterTest, WhatWasOverwrittenBetweenTwoSnapshotsIsALossOfBoth) {
  writer.add(0, tick_page(100, 1));
  write_snapshot("snapshot-1");
  writer.add(0, tick_page(300, 3, kOverwritten));
  write_snapshot("snapshot-2");
  EXPECT_THAT(read("run/snapshot-2"), ElementsAre("3")) << "a snapshot alone lost nothing within";
  EXPECT_THAT(read("run"), ElementsAre("1", "lost 1", "3"));
}

TEST_F(SnapshotWriterTest, WhatWasClearedIsNotInTheNextSnapshotAndIsNoLoss) {
  writer.add(0, tick_page(100, 1));
  write_snapshot("snapshot-1");
  writer.clear();
  writer.add(0, tick_page(200, 2));
  write_snapshot("snapshot-2");
  EXPECT_THAT(read("run/snapshot-2"), ElementsAre("2"));
  EXPECT_THAT(read("run"), ElementsAre("1", "2"));
}

TEST_F(SnapshotWriterTest, AThreadKeepsTheNameThatAnEarlierSnapshotHasLearnt) {
  writer.add(0, newtask_page(50, "talker"));
  writer.add(0, tick_page(100, 1));
  write_snapshot("snapshot-1");
  writer.clear();
  writer.add(0, tick_page(200, 2));
  write_snapshot("snapshot-2");
  writer.add(0, tick_page(300, 3, kOverwritten));
  write_snapshot("snapshot-3");
  EXPECT_THAT(read("run"), ElementsAre("1talker", "2talker", "lost 1", "3"))
      << "after a gap the number may belong to another thread";
}

}  // namespace
