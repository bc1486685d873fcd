// SPDX-License-Identifier: Apache-2.0
// Reads the traces that LTTng records of programs that fire ros2 events.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/unit/reader/recording_sink.hpp"
#include "tracetools/events.h"
#include "tracing/decode/reader/ros2_decoder.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {
namespace {

using test_support::run_command;
using ::testing::IsEmpty;
using testing::RecordingSink;

class RecordedTrace : public ::testing::Test {
 protected:
  void run(const std::vector<std::string>& argv) {
    const auto result = run_command(argv);
    ASSERT_EQ(result.exit_code, 0) << argv[0] << ' ' << result.err;
  }
  // Records `traced` in a session whose channel has these options and the contexts vpid, vtid, procname, in this order.
  void record(const std::vector<std::string>& channel_options, const std::vector<std::string>& traced) {
    ASSERT_NO_FATAL_FAILURE(start(channel_options));
    ASSERT_NO_FATAL_FAILURE(run(traced));
    run({"lttng", "destroy"});
  }
  void start(const std::vector<std::string>& channel_options) {
    std::vector<std::string> channel{"lttng", "enable-channel", "--userspace", "ros2"};
    channel.insert(channel.end(), channel_options.begin(), channel_options.end());
    for (const std::vector<std::string>& argv : std::vector<std::vector<std::string>>{
             {"lttng-sessiond", "--daemonize"},
             {"lttng", "create", "reading", "--output=" + trace_.string()},
             channel,
             {"lttng", "enable-event", "--userspace", "--channel=ros2", "ros2:*"},
             {"lttng", "add-context", "--userspace", "--type=vpid", "--type=vtid", "--type=procname"},
             {"lttng", "start"}}) {
      ASSERT_NO_FATAL_FAILURE(run(argv));
    }
  }

  test_support::Sandbox sandbox_;
  std::filesystem::path trace_ = sandbox_.directory() / "trace";
};

// The names of the fields of an event, as its struct has them.
std::vector<std::string> expected_fields(const ros2::AnyEvent& any) {
  std::vector<std::string> names;
  std::visit(
      [&]<class Struct>(const Struct& event) {
        if constexpr (!std::is_same_v<Struct, std::monostate>) {
          Struct::for_each_field(event, [&]<ros2::FieldType type>(std::string_view name, const auto&) {
            // In CTF a field of its own holds the length of a sequence, before the sequence.
            if (type == ros2::FieldType::kPointers) {
              names.push_back("_" + std::string(name) + "_length");
            }
            names.emplace_back(name);
          });
        }
      },
      any);
  return names;
}

TEST_F(RecordedTrace, DecodesEveryEventOfTracetools) {
  ASSERT_NO_FATAL_FAILURE(record({}, {FIRE_ALL_EVENTS}));

  std::vector<std::string> problems;
  ros2::Decoder decoder([&](const std::string& problem) { problems.push_back(problem); });
  std::map<std::string, ros2::AnyEvent> decoded;
  std::string version;
  RecordingSink sink;
  sink.also = [&](const Event& event) {
    const ros2::AnyEvent* any = decoder.decode(event);
    ASSERT_NE(any, nullptr) << event.name();
    EXPECT_EQ(event.event_class->fields, expected_fields(*any)) << event.name();
    EXPECT_EQ(event.vpid, event.vtid);
    EXPECT_EQ(event.procname, "fire_all_events");
    if (const auto* init = std::get_if<ros2::RclInit>(any)) {
      version = init->version;
    }
    decoded[std::string(event.name())] = *any;
  };
  TraceReader(trace_).read(sink);

  EXPECT_THAT(problems, IsEmpty());
  EXPECT_THAT(sink.losses, IsEmpty());
  std::set<std::string> names;
  for (const auto& [name, event] : decoded) {
    names.insert(name);
  }
#define EVENT_NAME(name, ...) "ros2:" #name,
  EXPECT_EQ(names, (std::set<std::string>{TRACETOOLS_EVENTS(EVENT_NAME)}));
#undef EVENT_NAME

  EXPECT_NE(version, "");
  EXPECT_EQ(decoded["ros2:rmw_publish"], (ros2::AnyEvent(ros2::RmwPublish{1, 2, 1767225600506920000})));
  EXPECT_EQ(decoded["ros2:rmw_take"], (ros2::AnyEvent(ros2::RmwTake{1, 0xffffffffffffffff, -1, true})));
  EXPECT_EQ(decoded["ros2:rclcpp_executor_wait_for_work"], ros2::AnyEvent(ros2::RclcppExecutorWaitForWork{-1}));
  EXPECT_EQ(decoded["ros2:message_link_periodic_async"],
            (ros2::AnyEvent(ros2::MessageLinkPeriodicAsync{{0x51, 0x52}, {0x61}})));
  EXPECT_EQ(std::get<ros2::RmwClientInit>(decoded["ros2:rmw_client_init"]).gid,
            (ros2::Gid{{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 30, 255}, 16}));
}

TEST_F(RecordedTrace, CountsEveryEventThatLttngDiscarded) {
  constexpr std::uint64_t kFired = 20'000;
  ASSERT_NO_FATAL_FAILURE(
      record({"--subbuf-size=4096", "--num-subbuf=2"}, {TRACED_APP, std::to_string(kFired), "200"}));

  RecordingSink sink;
  TraceReader(trace_).read(sink);

  std::uint64_t lost = 0;
  for (const testing::SeenLoss& loss : sink.losses) {
    EXPECT_EQ(loss.kind, Loss::Kind::kEvents);
    EXPECT_THAT(loss.stream, ::testing::StartsWith("ros2_"));
    ASSERT_TRUE(loss.count.has_value());
    lost += *loss.count;
  }
  EXPECT_GT(lost, 0u);
  EXPECT_EQ(sink.events.size() + lost, kFired + 1) << "and the one rcl_init";
}

TEST_F(RecordedTrace, IsReadWhileItIsBeingWritten) {
  ASSERT_NO_FATAL_FAILURE(start({"--subbuf-size=4096", "--num-subbuf=2"}));
  ASSERT_NO_FATAL_FAILURE(run({TRACED_APP, "20000", "200"}));
  RecordingSink early;
  TraceReader open(trace_);
  EXPECT_EQ(open.open_directories().size(), 1u);
  open.read(early);  // throws nothing: what is not there yet is no damage

  ASSERT_NO_FATAL_FAILURE(run({"lttng", "destroy"}));
  RecordingSink late;
  TraceReader whole(trace_);
  EXPECT_THAT(whole.open_directories(), IsEmpty());
  whole.read(late);
  EXPECT_GT(late.events.size(), 0u);
  EXPECT_LE(early.events.size(), late.events.size());
}

TEST_F(RecordedTrace, KnowsTheProcessOfItsOwnBuffers) {
  ASSERT_NO_FATAL_FAILURE(
      record({"--buffers-pid", "--subbuf-size=4096", "--num-subbuf=2"}, {TRACED_APP, "20000", "200"}));

  RecordingSink sink;
  TraceReader(trace_).read(sink);

  ASSERT_FALSE(sink.losses.empty());
  EXPECT_EQ(sink.losses[0].vpid, sink.events[0].vpid);
}

}  // namespace
}  // namespace tracing
