// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/kernel/thread_table.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>

namespace {

using tracing::kernel::parse_event_format;
using tracing::kernel::ThreadTable;

constexpr const char* kNewtask =
    "name: task_newtask\nID: 205\n"
    "\tfield:pid_t pid;\toffset:8;\tsize:4;\tsigned:1;\n"
    "\tfield:char comm[16];\toffset:12;\tsize:16;\tsigned:0;\n"
    "\tfield:u64 clone_flags;\toffset:32;\tsize:8;\tsigned:0;\n";
constexpr const char* kRename =
    "name: task_rename\nID: 204\n"
    "\tfield:pid_t pid;\toffset:8;\tsize:4;\tsigned:1;\n"
    "\tfield:char oldcomm[16];\toffset:12;\tsize:16;\tsigned:0;\n"
    "\tfield:char newcomm[16];\toffset:28;\tsize:16;\tsigned:0;\n";

// No kernel gives such a high number, so /proc has nothing about it.
constexpr std::int32_t kShell = 0x7f000001;
constexpr std::int32_t kThread = 0x7f000002;

struct Record {
  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(48);
  template <typename T>
  Record& put(std::size_t offset, T value) {
    std::memcpy(bytes.data() + offset, &value, sizeof value);
    return *this;
  }
  Record& put(std::size_t offset, const char* text) {
    std::memcpy(bytes.data() + offset, text, std::strlen(text));
    return *this;
  }
};

Record newtask(std::int32_t parent, std::int32_t pid, const char* name, std::uint64_t flags) {
  Record record;
  record.put(0, std::uint16_t{205}).put(4, parent).put(8, pid).put(12, name).put(32, flags);
  return record;
}

Record rename(std::int32_t pid, const char* from, const char* to) {
  Record record;
  record.put(0, std::uint16_t{204}).put(4, pid).put(8, pid).put(12, from).put(28, to);
  return record;
}

struct ThreadTableTest : testing::Test {
  std::string seen(std::int32_t thread, std::uint64_t time) {
    const tracing::kernel::Thread found = table.find(thread, time);
    return found.name + " of " + (found.process == kShell ? "the shell" : found.process == thread ? "its own" : "?");
  }
  ThreadTable table{parse_event_format(kNewtask), parse_event_format(kRename)};
};

TEST_F(ThreadTableTest, AThreadHasTheNameThatItHadThen) {
  table.learn(100, newtask(1, kShell, "sh", 0).bytes);
  table.learn(200, rename(kShell, "sh", "talker").bytes);
  table.learn(300, newtask(kShell, kThread, "talker", 0x10000).bytes);
  table.learn(400, rename(kThread, "talker", "dds.udp").bytes);
  EXPECT_EQ(seen(kShell, 150), "sh of the shell");
  EXPECT_EQ(seen(kShell, 200), "talker of the shell");
  EXPECT_EQ(seen(kThread, 350), "talker of the shell");
  EXPECT_EQ(seen(kThread, 450), "dds.udp of the shell");
  table.forget_the_past();
  EXPECT_EQ(seen(kThread, 450), "dds.udp of the shell");
}

TEST_F(ThreadTableTest, ANumberThatIsUsedAgainIsAnotherProcess) {
  table.learn(100, newtask(1, kShell, "sh", 0).bytes);
  table.learn(150, newtask(kShell, kThread, "sh", 0x10000).bytes);
  table.learn(500, newtask(1, kThread, "make", 0).bytes);
  EXPECT_EQ(seen(kThread, 200), "sh of the shell");
  EXPECT_EQ(seen(kThread, 500), "make of its own");
}

TEST_F(ThreadTableTest, WhatIsRenamedWithoutHavingBeenSeenHadItsOldNameBefore) {
  table.learn(200, rename(kThread, "first", "second").bytes);
  EXPECT_EQ(seen(kThread, 100), "first of its own");
  EXPECT_EQ(seen(kThread, 300), "second of its own");
}

TEST_F(ThreadTableTest, WhatRanBeforeIsReadFromProcAndWhatHasGoneHasNoName) {
  EXPECT_EQ(table.find(getpid(), 1).process, getpid());
  EXPECT_EQ(table.find(getpid(), 1).name, "trace_kernel_te");
  EXPECT_EQ(seen(kThread, 1), " of its own");
}

}  // namespace
