// SPDX-License-Identifier: Apache-2.0
// The same run, as the versions of ros2_tracing have recorded it since the paper. What an old version does not record
// is not in the results, and what is there is as with the newest one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"

namespace tracing {
namespace {

using testing::TemporaryDirectory;
using testing::TraceWriter;

struct Version {
  const char* name;
  std::size_t gid_size;
  // Of rmw_publish: the name of the field for the publisher, which has a timestamp beside it; "" for the message alone.
  const char* publisher_field;
};

// Versions that differ in fields. Those between have the fields of the one before.
constexpr Version kVersions[] = {{"4.1.0", 24, ""},
                                 {"8.0.0", 24, "publisher_handle"},
                                 {"8.1.0", 24, "rmw_publisher_handle"},
                                 {"8.4.0", 16, "rmw_publisher_handle"},
                                 {"8.10.1", 16, "rmw_publisher_handle"}};

class VersionWriter {
 public:
  // `with_writes`: the middleware records dds:write.
  VersionWriter(const std::filesystem::path& directory, const Version& version, bool with_writes = false)
      : writer_(directory), version_(version), with_writes_(with_writes) {}

  void write(const testing::SequenceEvent& recorded) {
    std::visit([&](const auto& event) { write(recorded, event); }, recorded.event);
  }
  void finish() { writer_.finish(); }

 private:
  static std::string pointer(const std::string& name) {
    return testing::detail::describe_field(ros2::FieldType::kPointer, name);
  }
  void raw(const testing::SequenceEvent& recorded, const char* name, const std::string& fields,
           const std::string& payload) {
    const auto [id, is_new] = ids_.try_emplace(name, 0);
    if (is_new) {
      id->second = writer_.declare(name, fields);
    }
    writer_.write_raw(recorded.thread.vpid == testing::kPing.vpid ? 0 : 1, recorded.time_ns, recorded.thread,
                      id->second, payload);
  }
  void write_gid(const testing::SequenceEvent& recorded, const char* name, const std::string& handle_field,
                 ros2::Handle handle) {
    std::string payload;
    testing::detail::append(payload, handle);
    payload.append(version_.gid_size, static_cast<char>(handle));
    raw(recorded, name,
        pointer(handle_field) + "\t\tinteger { size = 8; align = 8; signed = 0; encoding = none; base = 10; } _gid[" +
            std::to_string(version_.gid_size) + "];\n",
        payload);
  }

  template <class Struct>
  void write(const testing::SequenceEvent& recorded, const Struct& event) {
    if constexpr (std::is_same_v<Struct, ros2::RclInit>) {
      writer_.write(recorded.thread.vpid == testing::kPing.vpid ? 0 : 1, recorded.time_ns, recorded.thread,
                    ros2::RclInit{event.context_handle, version_.name});
    } else if constexpr (std::is_same_v<Struct, ros2::RmwPublisherInit>) {
      write_gid(recorded, "ros2:rmw_publisher_init", "rmw_publisher_handle", event.rmw_publisher_handle);
    } else if constexpr (std::is_same_v<Struct, ros2::RmwSubscriptionInit>) {
      write_gid(recorded, "ros2:rmw_subscription_init", "rmw_subscription_handle", event.rmw_subscription_handle);
    } else if constexpr (std::is_same_v<Struct, ros2::RmwPublish>) {
      const std::string publisher = version_.publisher_field;
      std::string payload;
      if (!publisher.empty()) {
        testing::detail::append(payload, event.rmw_publisher_handle);
      }
      testing::detail::append(payload, event.message);
      if (!publisher.empty()) {
        testing::detail::append(payload, event.timestamp);
      }
      raw(recorded, "ros2:rmw_publish",
          publisher.empty() ? pointer("message")
                            : pointer(publisher) + pointer("message") +
                                  testing::detail::describe_field(ros2::FieldType::kInt64, "timestamp"),
          payload);
      if (with_writes_) {
        write_dds(recorded, event.timestamp);
      }
    } else if constexpr (!std::is_same_v<Struct, std::monostate>) {
      writer_.write(recorded.thread.vpid == testing::kPing.vpid ? 0 : 1, recorded.time_ns, recorded.thread, event);
    }
  }

  void write_dds(testing::SequenceEvent recorded, std::int64_t timestamp) {
    recorded.time_ns += 500;
    std::string payload(16, '\1');
    testing::detail::append(payload, timestamp);
    raw(recorded, "dds:write",
        pointer("writer") + pointer("data") + testing::detail::describe_field(ros2::FieldType::kInt64, "timestamp"),
        payload);
  }

  TraceWriter writer_;
  Version version_;
  bool with_writes_;
  std::map<std::string, std::uint16_t> ids_;
};

class TracetoolsVersions : public ::testing::TestWithParam<Version> {
 protected:
  TraceResults results(bool with_writes = false) {
    VersionWriter writer(directory_.path(), GetParam(), with_writes);
    for (const testing::SequenceEvent& event : testing::ping_pong_sequence()) {
      writer.write(event);
    }
    writer.finish();
    TraceAnalysis analysis;
    TraceReader(directory_.path()).read(analysis);
    return analysis.finish();
  }
  bool has_timestamps() const { return *GetParam().publisher_field != '\0'; }

  TemporaryDirectory directory_;
};

TEST_P(TracetoolsVersions, HaveTheSameCallbacksAndCounts) {
  const TraceResults results = this->results();
  ASSERT_EQ(results.overview.processes.size(), 2u);
  ASSERT_EQ(results.ros2.callbacks.size(), 3u);
  EXPECT_EQ(results.ros2.callbacks[0].node, "/ping");
  EXPECT_EQ(results.ros2.callbacks[0].owner_name, "/pong");
  EXPECT_EQ(results.ros2.callbacks[0].durations.max_ns, 30'000);
  EXPECT_EQ(results.ros2.callbacks[1].period_ns, 500'000'000);
  EXPECT_EQ(results.ros2.callbacks[2].durations.max_ns, 80'000);
  ASSERT_EQ(results.ros2.topics.size(), 2u);
  for (const TopicResult& topic : results.ros2.topics) {
    EXPECT_EQ(topic.published, 1u) << topic.name;
    EXPECT_EQ(topic.received, 1u) << topic.name;
    EXPECT_EQ(topic.published_only + topic.received_only, 0u) << topic.name;
  }
}

void expect_followed(const TraceResults& results) {
  for (const TopicResult& topic : results.ros2.topics) {
    EXPECT_EQ(topic.latency.count, 1u) << topic.name;
  }
  for (const SubscriptionResult& subscription : results.ros2.subscriptions) {
    EXPECT_EQ(subscription.dropped(), 0u) << "nothing was lost";
  }
  EXPECT_FALSE(results.ros2.chains.empty());
}

std::uint64_t estimated(const TraceResults& results) {
  std::uint64_t count = 0;
  for (const UnmatchedResult& unmatched : results.ros2.unmatched) {
    count += unmatched.reason.find("an estimate") != std::string::npos ? unmatched.count : 0;
  }
  return count;
}

TEST_P(TracetoolsVersions, FollowMessagesAndSayWhereThatIsAnEstimate) {
  const TraceResults results = this->results();
  expect_followed(results);
  EXPECT_EQ(estimated(results), has_timestamps() ? 0u : 2u);
  if (!has_timestamps()) {
    EXPECT_THAT(results.warnings, ::testing::Contains("ros2:rmw_publish has no field timestamp"));
  }
}

TEST_P(TracetoolsVersions, FollowMessagesByTheWritesOfTheMiddleware) {
  const TraceResults results = this->results(true);
  expect_followed(results);
  EXPECT_EQ(estimated(results), 0u);
}

INSTANTIATE_TEST_SUITE_P(Of, TracetoolsVersions, ::testing::ValuesIn(kVersions), [](const auto& version) {
  std::string name = version.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

}  // namespace
}  // namespace tracing
