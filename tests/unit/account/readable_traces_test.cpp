// SPDX-License-Identifier: Apache-2.0
// Traces of processes that ended before LTTng had described them.
#include "tracing/record/account/readable_traces.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/ctf/metadata_text.hpp"

namespace {

namespace fs = std::filesystem;
using tracing::Absence;

constexpr const char* kHalfName = "driver-48-20261122-190205";

struct ReadableTraces : testing::Test {
  void write(const fs::path& directory, int events) const {
    tracing::testing::TraceWriter writer(directory);
    for (int i = 0; i < events; ++i) {
      writer.write(0, 100 + i, tracing::testing::Thread{.vpid = 1, .vtid = 1, .procname = "a"},
                   tracing::ros2::RclTake{1});
    }
    writer.end_packet(0);
    writer.finish();
  }

  // What LTTng leaves: the metadata end before the description of the stream.
  void write_half(const fs::path& directory, int events) const {
    write(directory, events);
    const std::string text = tracing::ctf::read_metadata(directory / "metadata");
    const std::size_t stream = text.find("stream {");
    ASSERT_NE(stream, std::string::npos);
    test_support::write_file(directory / "metadata", text.substr(0, stream));
  }

  test_support::Sandbox sandbox;
  fs::path run = sandbox.directory() / "run";
};

TEST_F(ReadableTraces, ThatCannotBeReadArePutAside) {
  write(run / "ust/pid/talker-47-20261122-190204", 2);
  write_half(run / "ust/pid" / kHalfName, 2);
  ASSERT_EQ(tracing::find_unreadable(run / "ust").size(), 1u);
  EXPECT_EQ(
      tracing::put_unreadable_aside(run),
      (std::vector<Absence>{{.text = "the trace of process driver-48-20261122-190205 cannot be read: its metadata "
                                     "do not describe its streams; it is in unreadable/driver-48-20261122-190205 "
                                     "now",
                             .is_loss = true}}));
  EXPECT_TRUE(fs::exists(run / "ust/pid/talker-47-20261122-190204/metadata"));
  EXPECT_FALSE(fs::exists(run / "ust/pid" / kHalfName));
  EXPECT_TRUE(fs::exists(run / "unreadable" / kHalfName / "metadata.unreadable"));
  EXPECT_FALSE(fs::exists(run / "unreadable" / kHalfName / "metadata")) << "readers would find it";
  EXPECT_TRUE(tracing::find_unreadable(run / "ust").empty());
  EXPECT_EQ(test_support::run_command({"babeltrace2", run.string()}).exit_code, 0);
}

TEST_F(ReadableTraces, WithoutEventsAreNothingToTell) {
  write_half(run / "ust/pid" / kHalfName, 0);
  ASSERT_EQ(tracing::find_unreadable(run / "ust").size(), 1u);
  EXPECT_TRUE(tracing::find_unreadable(run / "ust")[0].is_empty);
  EXPECT_TRUE(tracing::put_unreadable_aside(run).empty());
  EXPECT_FALSE(fs::exists(run / "ust/pid" / kHalfName));
}

TEST_F(ReadableTraces, OfAllProcessesAreToldOfAndLeft) {
  write_half(run / "ust/uid/0/64-bit", 2);
  EXPECT_TRUE(tracing::put_unreadable_aside(run).empty());
  EXPECT_EQ(tracing::describe_unreadable(run),
            "the trace in ust/uid/0/64-bit cannot be read: its metadata do not describe its streams");
  fs::remove(run / "ust/uid/0/64-bit/metadata");
  EXPECT_EQ(tracing::describe_unreadable(run), "the trace in ust/uid/0/64-bit cannot be read: it has no metadata");
  test_support::write_file(run / "ust/uid/0/64-bit/metadata", "");
  EXPECT_NE(tracing::describe_unreadable(run), "");
  EXPECT_EQ(tracing::describe_unreadable(run / "nowhere"), "");
}

}  // namespace
