// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/ros2_decoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/reader/ext_events.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::TemporaryDirectory;
using testing::Thread;
using testing::TraceWriter;

constexpr Thread kThread{71, 71, "ping"};

// Decodes every event and passes it on while it is valid.
class DecodingSink : public TraceSink {
 public:
  std::function<void(const ros2::AnyEvent*)> check;
  std::vector<std::string> problems;
  std::size_t count = 0;

  void on_event(const Event& event) override {
    ++count;
    check(decoder_.decode(event));
  }
  void on_loss(const Loss&) override {}

 private:
  ros2::Decoder decoder_{[this](const std::string& problem) { problems.push_back(problem); }};
};

// A struct with a different value in every field.
template <class Struct>
Struct filled() {
  Struct event;
  std::uint64_t next = 0x1000;
  Struct::for_each_field(event, [&]<ros2::FieldType type>(std::string_view name, auto& member) {
    ++next;
    if constexpr (type == ros2::FieldType::kString) {
      member = name;
    } else if constexpr (type == ros2::FieldType::kBool) {
      member = true;
    } else if constexpr (type == ros2::FieldType::kGid) {
      member.size = 16;
      for (std::size_t i = 0; i < 16; ++i) {
        member.bytes[i] = static_cast<std::uint8_t>(0xf0 + i);
      }
    } else if constexpr (type == ros2::FieldType::kPointers) {
      member = {next, next + 1, 0xffffffffffffffff};
    } else if constexpr (type == ros2::FieldType::kInt64) {
      member = -static_cast<std::int64_t>(next);
    } else {
      member = next | 0xffff000000000000;
    }
  });
  return event;
}

std::vector<ros2::AnyEvent> one_of_each() {
  std::vector<ros2::AnyEvent> events;
#define TRACING_FILL(given_, name_, struct_, ...) events.emplace_back(filled<ros2::struct_>());
  TRACETOOLS_EVENT_TABLE(TRACING_FILL, )
#undef TRACING_FILL
  return events;
}

TEST(Ros2Decoder, DecodesEveryFieldOfEveryEvent) {
  const TemporaryDirectory directory;
  const std::vector<ros2::AnyEvent> written = one_of_each();
  EXPECT_EQ(written.size(), 42u);
  TraceWriter writer(directory.path());
  std::int64_t time = 0;
  for (const ros2::AnyEvent& event : written) {
    writer.write(0, ++time, kThread, event);
  }
  writer.finish();

  DecodingSink sink;
  sink.check = [&](const ros2::AnyEvent* event) {
    ASSERT_NE(event, nullptr) << sink.count;
    EXPECT_EQ(*event, written[sink.count - 1]) << "event number " << sink.count;
  };
  TraceReader(directory.path()).read(sink);

  EXPECT_EQ(sink.count, 42u);
  EXPECT_THAT(sink.problems, IsEmpty());
}

TEST(Ros2Decoder, IgnoresEventsOfOtherProviders) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  writer.write_raw(0, 1, kThread, writer.declare("lttng_ust_tracef:event", "\t\tstring _msg;\n"),
                   std::string_view("hello\0", 6));
  writer.finish();

  DecodingSink sink;
  sink.check = [](const ros2::AnyEvent* event) { EXPECT_EQ(event, nullptr); };
  TraceReader(directory.path()).read(sink);
  EXPECT_EQ(sink.count, 1u);
  EXPECT_THAT(sink.problems, IsEmpty());
}

TEST(ObjectEndDecoder, KnowsTheEndsOfObjectsByTheirNames) {
  using Kind = ros2::ObjectEnd::Kind;
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  constexpr const char* kField = "\t\tinteger { size = 64; align = 8; signed = 0; base = 16; } _handle;\n";
  const std::string handle("\x08\x07\x06\x05\x04\x03\x02\x01", 8);
  const std::uint16_t node = writer.declare("ros2_ext:rcl_node_fini", kField);
  const std::uint16_t callback = writer.declare("ros2_ext:rclcpp_callback_fini", kField);
  const std::uint16_t other = writer.declare("ros2_ext:rclcpp_executor_execute_client", kField);
  std::int64_t time = 0;
  for (const std::uint16_t id : {node, callback, other, node}) {
    writer.write_raw(0, ++time, kThread, id, handle);
  }
  writer.finish();

  class Sink : public TraceSink {
   public:
    void on_event(const Event& event) override { ends.push_back(decoder.decode(event)); }
    void on_loss(const Loss&) override {}
    ros2::ObjectEndDecoder decoder;
    std::vector<std::optional<ros2::ObjectEnd>> ends;
  } sink;
  TraceReader(directory.path()).read(sink);

  constexpr ros2::Handle kHandle = 0x0102030405060708;
  EXPECT_THAT(sink.ends,
              ElementsAre(ros2::ObjectEnd{Kind::kRclNode, kHandle}, ros2::ObjectEnd{Kind::kRclcppCallback, kHandle},
                          std::nullopt, ros2::ObjectEnd{Kind::kRclNode, kHandle}));
}

TEST(ExecutionEventDecoder, KnowsWhatExecutorsAndClientsDo) {
  using Kind = ros2::ExecutionEvent::Kind;
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  constexpr const char* kField = "\t\tinteger { size = 64; align = 8; signed = 0; base = 16; } _handle;\n";
  const std::string handle("\x08\x07\x06\x05\x04\x03\x02\x01", 8);
  std::int64_t time = 0;
  for (const char* name : {"ros2_ext:rclcpp_executor_execute_service", "ros2_ext:rclcpp_executor_execute_client",
                           "ros2_ext:rclcpp_executor_execute_waitable", "ros2_ext:rclcpp_client_callback_start",
                           "ros2_ext:rclcpp_client_callback_end", "ros2_ext:rcl_node_fini"}) {
    writer.write_raw(0, ++time, kThread, writer.declare(name, kField), handle);
  }
  writer.finish();

  class Sink : public TraceSink {
   public:
    void on_event(const Event& event) override { events.push_back(decoder.decode(event)); }
    void on_loss(const Loss&) override {}
    ros2::ExecutionEventDecoder decoder;
    std::vector<std::optional<ros2::ExecutionEvent>> events;
  } sink;
  TraceReader(directory.path()).read(sink);

  constexpr ros2::Handle kHandle = 0x0102030405060708;
  using Decoded = ros2::ExecutionEvent;
  EXPECT_THAT(sink.events, ElementsAre(Decoded{Kind::kService, kHandle}, Decoded{Kind::kClient, kHandle},
                                       Decoded{Kind::kWaitable, kHandle}, Decoded{Kind::kClientCallbackStart, kHandle},
                                       Decoded{Kind::kClientCallbackEnd, kHandle}, std::nullopt));
}

std::string bytes(std::initializer_list<std::uint64_t> values) {
  std::string result;
  for (const std::uint64_t value : values) {
    testing::detail::append(result, value);
  }
  return result;
}

// LTTng records a truth value as a signed number.
TEST(EndpointQosDecoder, ReadsTruthValuesAndNumbers) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  const std::uint16_t id = writer.declare("ros2_ext:rmw_subscription_qos",
                                          "\t\tinteger { size = 64; align = 8; signed = 0; base = 16; } _handle;\n"
                                          "\t\tinteger { size = 32; align = 8; signed = 1; } _reliable;\n"
                                          "\t\tinteger { size = 64; align = 8; signed = 0; } _history_depth;\n"
                                          "\t\tinteger { size = 32; align = 8; signed = 1; } _is_filtered;\n");
  const std::string handle("\x08\x07\x06\x05\x04\x03\x02\x01", 8);
  const std::string yes("\x01\0\0\0", 4);
  const std::string seven("\x07\0\0\0\0\0\0\0", 8);
  writer.write_raw(0, 1, kThread, id, handle + yes + seven + yes);
  writer.finish();

  class Sink : public TraceSink {
   public:
    void on_event(const Event& event) override {
      if (decoder.decode(event)) {
        qos = ros2::EndpointQosEvent::qos(event);
      }
    }
    void on_loss(const Loss&) override {}
    ros2::EndpointQosDecoder decoder;
    std::optional<ros2::EndpointQos> qos;
  } sink;
  TraceReader(directory.path()).read(sink);
  EXPECT_EQ(sink.qos, (ros2::EndpointQos{true, 7, true}));
}

TEST(Ros2Decoder, ReportsAMissingFieldOnceAndDecodesTheRest) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  // As in ROS 2 Humble.
  const std::uint16_t id =
      writer.declare("ros2:rmw_publish", testing::detail::describe_field(ros2::FieldType::kPointer, "message"));
  writer.write_raw(0, 1, kThread, id, bytes({0xabc}));
  writer.write_raw(0, 2, kThread, id, bytes({0xabc}));
  writer.finish();

  DecodingSink sink;
  sink.check = [](const ros2::AnyEvent* event) {
    ASSERT_NE(event, nullptr);
    EXPECT_EQ(*event, (ros2::AnyEvent(ros2::RmwPublish{0, 0xabc, 0})));
  };
  TraceReader(directory.path()).read(sink);
  EXPECT_EQ(sink.count, 2u);
  EXPECT_THAT(sink.problems, ElementsAre("ros2:rmw_publish has no field rmw_publisher_handle",
                                         "ros2:rmw_publish has no field timestamp"));
}

TEST(Ros2Decoder, ReportsAFieldOfAnotherType) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  const std::uint16_t id = writer.declare("ros2:rcl_take", "\t\tstring _message;\n");
  writer.write_raw(0, 1, kThread, id, std::string_view("text\0", 5));
  writer.finish();

  DecodingSink sink;
  sink.check = [](const ros2::AnyEvent* event) {
    ASSERT_NE(event, nullptr);
    EXPECT_EQ(*event, ros2::AnyEvent(ros2::RclTake{0}));
  };
  TraceReader(directory.path()).read(sink);
  EXPECT_THAT(sink.problems, ElementsAre("ros2:rcl_take: field message is not a pointer"));
}

TEST(Ros2Decoder, IgnoresExtraFieldsAndTheirOrder) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  const std::uint16_t id = writer.declare(
      "ros2:callback_start", testing::detail::describe_field(ros2::FieldType::kUint64, "executor") +
                                 testing::detail::describe_field(ros2::FieldType::kBool, "is_intra_process") +
                                 testing::detail::describe_field(ros2::FieldType::kPointer, "callback"));
  std::string payload = bytes({7});
  testing::detail::append(payload, std::int32_t{1});
  payload += bytes({0xcb});
  writer.write_raw(0, 1, kThread, id, payload);
  writer.finish();

  DecodingSink sink;
  sink.check = [](const ros2::AnyEvent* event) {
    ASSERT_NE(event, nullptr);
    EXPECT_EQ(*event, (ros2::AnyEvent(ros2::CallbackStart{0xcb, true})));
  };
  TraceReader(directory.path()).read(sink);
  EXPECT_EQ(sink.count, 1u);
  EXPECT_THAT(sink.problems, IsEmpty());
}

TEST(Ros2Decoder, ReadsTheLongerGidOfOlderVersions) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path());
  const std::uint16_t id = writer.declare(
      "ros2:rmw_client_init", testing::detail::describe_field(ros2::FieldType::kPointer, "rmw_client_handle") +
                                  "\t\tinteger { size = 8; align = 8; signed = 0; } _gid[24];\n");
  writer.write_raw(0, 1, kThread, id, bytes({1}) + std::string(23, 'a') + 'b');
  writer.finish();

  DecodingSink sink;
  sink.check = [](const ros2::AnyEvent* event) {
    ASSERT_NE(event, nullptr);
    const auto& init = std::get<ros2::RmwClientInit>(*event);
    EXPECT_EQ(init.gid.size, 24u);
    EXPECT_EQ(init.gid.bytes[0], 'a');
    EXPECT_EQ(init.gid.bytes[23], 'b');
  };
  TraceReader(directory.path()).read(sink);
  EXPECT_THAT(sink.problems, IsEmpty());
}

// "rcl_node_init" to "RclNodeInit".
std::string camel_case(std::string_view name) {
  std::string result;
  bool first = true;
  for (const char c : name) {
    if (c != '_') {
      result += first ? static_cast<char>(std::toupper(c)) : c;
    }
    first = c == '_';
  }
  return result;
}

TEST(Ros2Events, HaveStructsOfTheirNames) {
  std::set<std::string_view> names;
#define TRACING_CHECK_NAME(given_, name_, struct_, ...)           \
  EXPECT_EQ(ros2::struct_::kName, "ros2:" + std::string(#name_)); \
  EXPECT_EQ(#struct_, camel_case(#name_));                        \
  names.insert(ros2::struct_::kName);
#define TRACING_CHECK_EXT_NAME(given_, name_, struct_, ...) EXPECT_EQ(#struct_, camel_case(#name_));
  TRACETOOLS_EVENT_TABLE(TRACING_CHECK_NAME, )
  TRACETOOLS_EXT_EVENT_TABLE(TRACING_CHECK_EXT_NAME, )
#undef TRACING_CHECK_EXT_NAME
#undef TRACING_CHECK_NAME
  EXPECT_EQ(names.size(), 42u);
  EXPECT_EQ(ros2::kEventCount, 42u);
}

TEST(Ros2Events, HaveTheNamesOfTheirFieldsInTheTrace) {
  std::vector<std::string> fields;
  const ros2::RclNodeInit event{.namespace_ = "/robot"};
  ros2::RclNodeInit::for_each_field(
      event, [&]<ros2::FieldType>(std::string_view name, const auto&) { fields.emplace_back(name); });
  EXPECT_THAT(fields, ElementsAre("node_handle", "rmw_handle", "node_name", "namespace"));
}

// Events of provider ros2_ext are decoded by name and first field.
TEST(ExtEvents, ThatAreDecodedAreInTheTable) {
  std::set<std::string> known;
#define TRACING_FIRST_FIELD(type_, name_) #type_,
#define TRACING_NOTE(provider_, name_, struct_, group_, ...)                                              \
  if (std::string(*std::begin({TRACETOOLS_EACH_FIELD(TRACING_FIRST_FIELD, __VA_ARGS__)})) == "pointer") { \
    known.insert(provider_ ":" #name_);                                                                   \
  }
  TRACETOOLS_EXT_EVENT_TABLE(TRACING_NOTE, "ros2_ext")
#undef TRACING_NOTE
#undef TRACING_FIRST_FIELD
  for (const auto& [name, kind] : ros2::ObjectEnd::kKinds) {
    EXPECT_TRUE(known.contains(std::string(name))) << name;
  }
  for (const auto& [name, kind] : ros2::ExecutionEvent::kKinds) {
    EXPECT_TRUE(known.contains(std::string(name))) << name;
  }
}

}  // namespace
}  // namespace tracing
