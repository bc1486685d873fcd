// SPDX-License-Identifier: Apache-2.0
// A run as CARET records it: the initialisation events under its own provider, maybe long after they happened and kind
// by kind, and the rest as ROS 2 records it.
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

using ros2::FieldType;
using testing::kPingPongBegin;
using testing::SequenceEvent;
using testing::TemporaryDirectory;
using testing::Thread;
using testing::TraceWriter;

constexpr std::int64_t kMillisecond = 1'000'000;
// When the session of a late trace begins. Nothing but initialisation happens before.
constexpr std::int64_t kSessionBegin = kPingPongBegin + 400 * kMillisecond;

enum class Recorded { kAtOnce, kLate, kTwice };

struct Form {
  const char* name;
  bool has_timestamps;  // dds_write has the fields of rmw_publish, as with Jazzy; without, the message alone
  Recorded recorded;
};

// An event of one of the processes, as bytes.
struct Bytes {
  std::string name;
  std::string fields;
  std::string payload;
  std::int64_t time_ns;  // of recording
  Thread thread;
};

class Payload {
 public:
  Payload& pointer(const char* name, ros2::Handle value) { return add(FieldType::kPointer, name, value); }
  Payload& number(const char* name, std::int64_t value) { return add(FieldType::kInt64, name, value); }
  Payload& text(const char* name, std::string_view value) {
    fields += testing::detail::describe_field(FieldType::kString, name);
    payload.append(value);
    payload.push_back('\0');
    return *this;
  }
  std::string fields;
  std::string payload;

 private:
  template <class Value>
  Payload& add(FieldType type, const char* name, Value value) {
    fields += testing::detail::describe_field(type, name);
    testing::detail::append(payload, value);
    return *this;
  }
};

class Caret {
 public:
  explicit Caret(const Form& form) : form_(form) {
    for (const SequenceEvent& recorded : testing::ping_pong_sequence()) {
      std::visit([&](const auto& event) { add(recorded, event); }, recorded.event);
    }
    add_executors();
  }

  void write(const std::filesystem::path& directory) {
    std::vector<Bytes> events = others_;
    if (form_.recorded != Recorded::kLate) {
      events.insert(events.end(), inits_.begin(), inits_.end());
    }
    if (form_.recorded != Recorded::kAtOnce) {
      std::stable_sort(inits_.begin(), inits_.end(),
                       [](const Bytes& left, const Bytes& right) { return left.name < right.name; });
      std::int64_t time_ns = kSessionBegin;
      for (Bytes init : inits_) {
        init.time_ns = time_ns += 10'000;  // all of them in less than 100 ms
        init.thread.vtid += 1000;
        events.push_back(init);
      }
    }
    std::stable_sort(events.begin(), events.end(),
                     [](const Bytes& left, const Bytes& right) { return left.time_ns < right.time_ns; });
    TraceWriter writer(directory);
    std::map<std::string, std::uint16_t> ids;
    for (const Bytes& event : events) {
      const auto [id, is_new] = ids.try_emplace(event.name, 0);
      if (is_new) {
        id->second = writer.declare(event.name, event.fields);
      }
      writer.write_raw(0, event.time_ns, event.thread, id->second, event.payload);
    }
    writer.finish();
  }

 private:
  void add_init(const SequenceEvent& when, const std::string& name, Payload payload) {
    payload.number("init_timestamp", when.time_ns - kPingPongBegin);  // since the machine has started
    inits_.push_back({"ros2_caret:" + name, payload.fields, payload.payload, when.time_ns, when.thread});
  }
  void add_other(const SequenceEvent& when, std::string_view name, const Payload& payload) {
    others_.push_back({std::string(name), payload.fields, payload.payload, when.time_ns, when.thread});
  }

  template <class Struct>
  void add(const SequenceEvent& when, const Struct& event) {
    if constexpr (std::is_same_v<Struct, ros2::RmwPublish>) {
      if (event.timestamp == kPingPongBegin + 1) {
        return;  // of the middleware
      }
      Payload payload;
      if (form_.has_timestamps) {
        payload.pointer("rmw_publisher_handle", event.rmw_publisher_handle)
            .pointer("message", event.message)
            .number("timestamp", event.timestamp);
      } else {
        payload.pointer("message", event.message);
      }
      add_other(when, "ros2_caret:dds_write", payload);
      SequenceEvent written = when;
      written.time_ns += 500;
      add_other(written, "ros2_caret:dds_bind_addr_to_stamp",
                Payload().pointer("addr", 0).number("source_stamp", event.timestamp));
    } else if constexpr (std::is_same_v<Struct, ros2::RmwTake>) {
      if (event.source_timestamp != 0) {
        add_as_it_is(when, event);
      }
    } else if constexpr (std::is_same_v<Struct, ros2::RclInit>) {
      add_init(when, "rcl_init", Payload().pointer("context_handle", event.context_handle));
    } else if constexpr (!std::is_same_v<Struct, std::monostate>) {
      const std::string name(Struct::kName.substr(5));
      if (name.find("executor") != std::string::npos || name.starts_with("rmw_") || name == "rcl_take" ||
          name == "rclcpp_take") {
        return;  // CARET leaves them out
      }
      if (name.ends_with("init") || name.ends_with("added") || name.ends_with("register") || name.ends_with("node")) {
        add_init(when, name, payload_of(event));
      } else {
        add_as_it_is(when, event);
      }
      if constexpr (std::is_same_v<Struct, ros2::RclTimerInit>) {
        timer_ = event.timer_handle;
      } else if constexpr (std::is_same_v<Struct, ros2::RclSubscriptionInit>) {
        subscriptions_[when.thread.vpid] = event.subscription_handle;
      }
    }
  }

  template <class Struct>
  static Payload payload_of(const Struct& event) {
    Payload payload;
    Struct::for_each_field(event, [&]<FieldType type>(std::string_view name, const auto& member) {
      payload.fields += testing::detail::describe_field(type, name);
      testing::detail::AppendField{payload.payload}.template operator()<type>(name, member);
    });
    return payload;
  }
  template <class Struct>
  void add_as_it_is(const SequenceEvent& when, const Struct& event) {
    add_other(when, Struct::kName, payload_of(event));
  }

  void add_executors() {
    const auto at = [](double ms, const Thread& thread) {
      return SequenceEvent{kPingPongBegin + static_cast<std::int64_t>(ms * kMillisecond), thread, {}};
    };
    const auto member = [](ros2::Handle group, const char* name, ros2::Handle handle) {
      return Payload().pointer("callback_group_addr", group).pointer(name, handle);
    };
    add_init(at(6.9, testing::kPing), "construct_executor",
             Payload().pointer("executor_addr", 0x500).text("executor_type_name", "multi_threaded_executor"));
    add_init(at(6.91, testing::kPing), "add_callback_group",
             Payload()
                 .pointer("executor_addr", 0x500)
                 .pointer("callback_group_addr", 0x501)
                 .text("group_type_name", "mutually_exclusive"));
    add_init(at(6.92, testing::kPing), "callback_group_add_timer", member(0x501, "timer_handle", timer_));
    add_init(at(6.93, testing::kPing), "callback_group_add_subscription",
             member(0x501, "subscription_handle", subscriptions_[testing::kPing.vpid]));
    add_init(at(26.3, testing::kPong), "callback_group_to_executor_entity_collector",
             Payload()
                 .pointer("entities_collector_addr", 0x602)
                 .pointer("callback_group_addr", 0x601)
                 .text("group_type_name", "reentrant"));
    add_init(at(26.31, testing::kPong), "callback_group_add_subscription",
             member(0x601, "subscription_handle", subscriptions_[testing::kPong.vpid]));
    add_init(at(26.7, testing::kPong), "executor_entity_collector_to_executor",
             Payload().pointer("executor_addr", 0x600).pointer("entities_collector_addr", 0x602));
    add_init(at(26.8, testing::kPong), "construct_executor",
             Payload().pointer("executor_addr", 0x600).text("executor_type_name", "single_threaded_executor"));
    add_other(at(507.15, testing::kPong), "ros2_caret:sim_time", Payload().number("stamp", 12));
  }

  Form form_;
  std::vector<Bytes> inits_;
  std::vector<Bytes> others_;
  ros2::Handle timer_ = 0;
  std::map<std::int64_t, ros2::Handle> subscriptions_;  // by process
};

class CaretTrace : public ::testing::TestWithParam<Form> {
 protected:
  CaretTrace() {
    Caret(GetParam()).write(directory_.path());
    TraceReader(directory_.path()).read(analysis_);
    results_ = analysis_.finish();
  }

  TemporaryDirectory directory_;
  TraceAnalysis analysis_;
  TraceResults results_;
};

TEST_P(CaretTrace, HasNodesAndCallbacks) {
  ASSERT_EQ(results_.ros2.callbacks.size(), 3u);
  EXPECT_EQ(results_.ros2.callbacks[0].node, "/ping");
  EXPECT_EQ(results_.ros2.callbacks[0].owner_name, "/pong");
  EXPECT_EQ(results_.ros2.callbacks[0].durations.max_ns, 30'000);
  EXPECT_EQ(results_.ros2.callbacks[1].period_ns, 500'000'000);
  EXPECT_EQ(results_.ros2.callbacks[2].node, "/pong");
  EXPECT_EQ(results_.ros2.callbacks[2].durations.max_ns, 80'000);
  EXPECT_EQ(results_.ros2.nodes.size(), 2u);
  EXPECT_TRUE(results_.warnings.empty());
}

TEST_P(CaretTrace, HasMessagesAndChains) {
  ASSERT_EQ(results_.ros2.topics.size(), 2u);
  for (const TopicResult& topic : results_.ros2.topics) {
    EXPECT_EQ(topic.published, 1u) << topic.name;
    EXPECT_EQ(topic.received, 1u) << topic.name;
    EXPECT_EQ(topic.latency.count, 1u) << topic.name;
    EXPECT_EQ(topic.published_only + topic.received_only, 0u) << topic.name;
  }
  for (const UnmatchedResult& unmatched : results_.ros2.unmatched) {
    EXPECT_THAT(unmatched.reason, ::testing::Not(::testing::HasSubstr("not certain")));
  }
  ASSERT_EQ(results_.ros2.chains.size(), 1u);
  EXPECT_EQ(results_.ros2.chains[0].steps.size(), 3u);
}

TEST_P(CaretTrace, HasExecutorsAndGroups) {
  const CallbackGroups& groups = analysis_.groups();
  ASSERT_EQ(groups.executors().size(), 2u);
  ASSERT_EQ(groups.groups().size(), 2u);
  const std::vector<CallbackObject>& callbacks = analysis_.objects().callbacks();
  for (const CallbackObject& callback : callbacks) {
    const ObjectId group = groups.group_of(callback);
    ASSERT_NE(group, kNoObject);
    const GroupObject& found = groups.groups()[group];
    ASSERT_NE(found.executor, kNoObject);
    const bool is_ping = analysis_.processes()[callback.process].vpid == testing::kPing.vpid;
    EXPECT_EQ(found.kind, is_ping ? "mutually_exclusive" : "reentrant");
    EXPECT_EQ(groups.executors()[found.executor].kind,
              is_ping ? "multi_threaded_executor" : "single_threaded_executor");
  }
  ASSERT_EQ(groups.simulated_times().size(), 1u);
  EXPECT_EQ(groups.simulated_times()[0].simulated_ns, 12);
}

INSTANTIATE_TEST_SUITE_P(
    Of, CaretTrace,
    ::testing::Values(Form{"HumbleAtOnce", false, Recorded::kAtOnce}, Form{"HumbleLate", false, Recorded::kLate},
                      Form{"HumbleTwice", false, Recorded::kTwice}, Form{"JazzyAtOnce", true, Recorded::kAtOnce},
                      Form{"JazzyLate", true, Recorded::kLate}, Form{"JazzyTwice", true, Recorded::kTwice}),
    [](const auto& form) { return std::string(form.param.name); });

}  // namespace
}  // namespace tracing
