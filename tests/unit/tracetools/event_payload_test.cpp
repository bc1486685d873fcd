// SPDX-License-Identifier: Apache-2.0
// Compares the events of ROS 2 with the trace that LTTng wrote and babeltrace2 reads: neither program is ours.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tracetools/tracetools.h"

namespace {

using test_support::run_command;

// For each event its fields, each with type and the value that fire_all_events.cpp gives.
constexpr const char* kEventRows = R"rows(
rcl_init: context_handle ptr 0x1, version str "8.10.1"
rcl_node_init: node_handle ptr 0x1, rmw_handle ptr 0x2, node_name str "ping", namespace str "/robot"
rmw_publisher_init: rmw_publisher_handle ptr 0x1, gid gid [ 1 2 3 4 5 6 7 8 9 10 11 12 0 0 30 255 ]
rcl_publisher_init: publisher_handle ptr 0x1, node_handle ptr 0x2, rmw_publisher_handle ptr 0x3, topic_name str "/ping", queue_depth u64 10
rclcpp_publish: message ptr 0x2
rclcpp_intra_publish: publisher_handle ptr 0x1, message ptr 0x2
rcl_publish: publisher_handle ptr 0x1, message ptr 0x2
rmw_publish: rmw_publisher_handle ptr 0x1, message ptr 0x2, timestamp i64 1767225600506920000
rmw_subscription_init: rmw_subscription_handle ptr 0x1, gid gid [ 1 2 3 4 5 6 7 8 9 10 11 12 0 0 30 255 ]
rcl_subscription_init: subscription_handle ptr 0x1, node_handle ptr 0x2, rmw_subscription_handle ptr 0x3, topic_name str "/pong", queue_depth u64 5
rclcpp_subscription_init: subscription_handle ptr 0x1, subscription ptr 0x2
rclcpp_subscription_callback_added: subscription ptr 0x1, callback ptr 0x2
rmw_take: rmw_subscription_handle ptr 0x1, message ptr 0xFFFFFFFFFFFFFFFF, source_timestamp i64 -1, taken bool 1
rcl_take: message ptr 0x1
rclcpp_take: message ptr 0x1
rcl_service_init: service_handle ptr 0x1, node_handle ptr 0x2, rmw_service_handle ptr 0x3, service_name str "/add"
rclcpp_service_callback_added: service_handle ptr 0x1, callback ptr 0x2
rmw_take_request: rmw_service_handle ptr 0x1, request ptr 0x2, client_gid gid [ 1 2 3 4 5 6 7 8 9 10 11 12 0 0 30 255 ], sequence_number i64 3, taken bool 0
rmw_send_response: rmw_service_handle ptr 0x1, response ptr 0x2, client_gid gid [ 1 2 3 4 5 6 7 8 9 10 11 12 0 0 30 255 ], sequence_number i64 3, timestamp i64 4
rmw_client_init: rmw_client_handle ptr 0x1, gid gid [ 1 2 3 4 5 6 7 8 9 10 11 12 0 0 30 255 ]
rcl_client_init: client_handle ptr 0x1, node_handle ptr 0x2, rmw_client_handle ptr 0x3, service_name str "/add"
rmw_send_request: rmw_client_handle ptr 0x1, request ptr 0x2, sequence_number i64 3
rmw_take_response: rmw_client_handle ptr 0x1, response ptr 0x2, sequence_number i64 3, source_timestamp i64 4, taken bool 1
rcl_timer_init: timer_handle ptr 0x1, period i64 500000000
rclcpp_timer_callback_added: timer_handle ptr 0x1, callback ptr 0x2
rclcpp_timer_link_node: timer_handle ptr 0x1, node_handle ptr 0x2
rclcpp_callback_register: callback ptr 0x1, symbol str "(null)"
callback_start: callback ptr 0x1, is_intra_process bool 1
callback_end: callback ptr 0x1
rcl_lifecycle_state_machine_init: node_handle ptr 0x1, state_machine ptr 0x2
rcl_lifecycle_transition: state_machine ptr 0x1, start_label str "unconfigured", goal_label str "configuring"
rclcpp_executor_get_next_ready:
rclcpp_executor_wait_for_work: timeout i64 -1
rclcpp_executor_execute: handle ptr 0x1
rclcpp_ipb_to_subscription: ipb ptr 0x1, subscription ptr 0x2
rclcpp_buffer_to_ipb: buffer ptr 0x1, ipb ptr 0x2
rclcpp_construct_ring_buffer: buffer ptr 0x1, capacity u64 18446744073709551615
rclcpp_ring_buffer_enqueue: buffer ptr 0x1, index u64 2, size u64 3, overwritten bool 1
rclcpp_ring_buffer_dequeue: buffer ptr 0x1, index u64 2, size u64 3
rclcpp_ring_buffer_clear: buffer ptr 0x1
message_link_periodic_async: _subs_length u64 2, subs ptr[_subs_length] [ 0x51 0x52 ], _pubs_length u64 1, pubs ptr[_pubs_length] [ 0x61 ]
message_link_partial_sync: _subs_length u64 1, subs ptr[_subs_length] [ 0x51 ], _pubs_length u64 0, pubs ptr[_pubs_length] [ ]
)rows";

// The same for provider ros2_ext.
constexpr const char* kExtEventRows = R"rows(
rcl_context_fini: context_handle ptr 0x1
rcl_node_fini: node_handle ptr 0x1
rmw_publisher_fini: rmw_publisher_handle ptr 0x1
rcl_publisher_fini: publisher_handle ptr 0x1
rmw_subscription_fini: rmw_subscription_handle ptr 0x1
rcl_subscription_fini: subscription_handle ptr 0x1
rclcpp_subscription_fini: subscription ptr 0x1
rmw_service_fini: rmw_service_handle ptr 0x1
rcl_service_fini: service_handle ptr 0x1
rmw_client_fini: rmw_client_handle ptr 0x1
rcl_client_fini: client_handle ptr 0x1
rcl_timer_fini: timer_handle ptr 0x1
rclcpp_callback_fini: callback ptr 0x1
rcl_lifecycle_state_machine_fini: state_machine ptr 0x1
rclcpp_ipb_fini: ipb ptr 0x1
rclcpp_ring_buffer_fini: buffer ptr 0x1
rmw_service_init: rmw_service_handle ptr 0x1, gid gid [ 1 2 3 4 5 6 7 8 9 10 11 12 0 0 30 255 ]
rmw_publisher_qos: rmw_publisher_handle ptr 0x1, reliable bool 1, history_depth u64 10, transient_local bool 0
rmw_subscription_qos: rmw_subscription_handle ptr 0x1, reliable bool 0, history_depth u64 0, transient_local bool 1, is_filtered bool 1
rclcpp_client_callback_start: client_handle ptr 0x1, sequence_number i64 3
rclcpp_client_callback_end: client_handle ptr 0x1, sequence_number i64 3
rclcpp_executor_execute_service: service_handle ptr 0x1
rclcpp_executor_execute_client: client_handle ptr 0x1
rclcpp_executor_execute_waitable: waitable ptr 0x1
state_dump_begin: events u64 2
state_dump_end: events u64 2
rcl_lifecycle_state: state_machine ptr 0x1, label str "active"
)rows";

// Fields of an event: "name type" each, in order, or "name = value".
using Fields = std::vector<std::string>;
using EventTable = std::map<std::string, Fields>;

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    if (end > begin) {
      parts.push_back(text.substr(begin, end - begin));
    }
    begin = end + separator.size();
  }
  return parts;
}

// The expected fields from `rows`; `field` makes each of them from name, type and value.
template <typename MakeField>
EventTable expected(const char* rows, MakeField field) {
  EventTable table;
  for (const std::string& row : split(rows, "\n")) {
    const std::size_t colon = row.find(':');
    Fields& fields = table[row.substr(0, colon)];
    for (const std::string& text : split(row.substr(colon + 1), ",")) {
      std::istringstream words(text);
      std::string name, type, value;
      words >> name >> type >> std::ws;
      std::getline(words, value);
      fields.push_back(field(name, type, value));
    }
  }
  return table;
}

// The text between two texts, "" if they don't occur.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t begin = text.find(before);
  if (begin == std::string::npos) {
    return "";
  }
  const std::size_t end = text.find(after, begin + before.size());
  return end == std::string::npos ? "" : text.substr(begin + before.size(), end - begin - before.size());
}

// Versions of LTTng differ in what they leave to the defaults of CTF, and processors in how they align numbers:
//   integer { size = 64; align = 8; signed = 0; encoding = none; base = 16; }
std::string type_of(const std::string& declaration) {
  if (!declaration.starts_with("integer {")) {
    return declaration == "string" ? "str" : declaration;
  }
  const auto attribute = [&](const std::string& name) { return between(declaration, " " + name + " = ", ";"); };
  const std::string is_signed = attribute("signed");
  const std::string kind = attribute("base") == "16" ? "x" : is_signed == "1" || is_signed == "true" ? "i" : "u";
  static const std::map<std::string, std::string> types = {{"x64", "ptr"}, {"i32", "bool"}};
  const auto found = types.find(kind + attribute("size"));
  return found == types.end() ? kind + attribute("size") : found->second;
}

// LTTng puts an underscore before every name.
std::string without_underscore(const std::string& name) {
  return name.starts_with('_') ? name.substr(1) : name;
}

// Reads the trace's metadata in CTF's language, which tell every reader about the events. A field is a line such as
//   integer { size = 8; … base = 10; } _gid[16];
EventTable declared_events(const std::string& provider, const std::string& metadata) {
  EventTable table;
  Fields* fields = nullptr;
  for (const std::string& line : split(metadata, "\n")) {
    if (const std::string event = between(line, "name = \"" + provider + ":", "\""); !event.empty()) {
      fields = &table[event];
    } else if (line == "};") {
      fields = nullptr;
    } else if (fields != nullptr && line.starts_with("\t\t") && line.ends_with(';')) {
      const std::size_t end = std::min(line.find('['), line.size() - 1);
      const std::size_t space = line.rfind(' ', end);
      const std::string name = without_underscore(line.substr(space + 1, end - space - 1));
      std::string type = type_of(line.substr(2, space - 2));
      if (end + 1 < line.size()) {
        std::istringstream count(line.substr(end + 1, line.rfind(']') - end - 1));
        std::string word;
        count >> word;
        type += "[" + without_underscore(word) + "]";
      }
      fields->push_back(name + " " + (type == "u8[16]" ? "gid" : type));
    }
  }
  return table;
}

// The output of babeltrace2 for each event, as "name = value". A line is such as
//   [1795257084.1] (+0.1) host ros2:rmw_client_init: { cpu_id = 1 }, { rmw_client_handle = 0x1, gid = [ [0] = 1, … ] }
EventTable printed_events(const std::string& provider, const std::string& text) {
  EventTable table;
  for (const std::string& line : split(text, "\n")) {
    const std::string event = between(line, " " + provider + ":", ":");
    if (event.empty()) {
      continue;
    }
    Fields& fields = table[event];
    for (const std::string& part : split(between(line, "}, {", "}"), ",")) {
      const std::size_t begin = part.find_first_not_of(' ');
      if (begin == std::string::npos) {
        continue;
      }
      std::string field = part.substr(begin, part.find_last_not_of(' ') + 1 - begin);
      if (field.starts_with('[')) {
        fields.back() += " " + field.substr(field.find("= ") + 2);  // one more element of an array
      } else {
        const std::size_t first = field.find("[ [0] = ");
        fields.push_back(first == std::string::npos ? field : field.substr(0, first + 2) + field.substr(first + 8));
      }
    }
  }
  return table;
}

class RecordedEvents : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_command({"lttng-sessiond", "--daemonize"}).exit_code, 0);
    // The test reads the language of CTF 1.8. Since 2.15 LTTng writes CTF 2 unless it is told otherwise.
    std::vector<std::string> create = {"lttng", "create", "payload", "--output=" + trace_.string()};
    if (run_command({"lttng", "create", "other", "--no-output", "--trace-format=ctf-1.8"}).exit_code == 0) {
      create.emplace_back("--trace-format=ctf-1.8");
    }
    for (const std::vector<std::string>& argv :
         std::vector<std::vector<std::string>>{create,
                                               {"lttng", "enable-event", "--userspace", "ros2:*,ros2_ext:*"},
                                               {"lttng", "start"},
                                               {FIRE_ALL_EVENTS},
                                               {"lttng", "destroy"}}) {
      const auto result = run_command(argv);
      ASSERT_EQ(result.exit_code, 0) << argv[0] << ' ' << result.err;
    }
  }

  test_support::Sandbox sandbox_;
  std::filesystem::path trace_ = sandbox_.directory() / "trace";
};

TEST_F(RecordedEvents, HaveTheNamesFieldsOrderAndTypesOfRos2) {
  std::filesystem::path folder;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(trace_)) {
    if (entry.path().filename() == "metadata") {
      folder = entry.path().parent_path();
    }
  }
  const auto metadata = run_command({"babeltrace2", "--output-format=ctf-metadata", folder.string()});
  ASSERT_EQ(metadata.exit_code, 0) << metadata.err;
  const auto declaration = [](const auto& name, const auto& type, const auto&) { return name + " " + type; };
  EXPECT_EQ(declared_events("ros2", metadata.out), expected(kEventRows, declaration));
  EXPECT_EQ(declared_events("ros2_ext", metadata.out), expected(kExtEventRows, declaration));
}

TEST_F(RecordedEvents, HoldTheArgumentsOfTheFunctions) {
  const auto text = run_command({"babeltrace2", trace_.string()});
  ASSERT_EQ(text.exit_code, 0) << text.err;
  const auto printed = [](const auto& name, const auto&, const auto& value) { return name + " = " + value; };
  EXPECT_EQ(printed_events("ros2", text.out), expected(kEventRows, printed));
  EXPECT_EQ(printed_events("ros2_ext", text.out), expected(kExtEventRows, printed));
}

#define EVENT_NAME(name, ...) #name,
const std::set<std::string> kDeclaredNames = {TRACETOOLS_EVENTS(EVENT_NAME)};
const std::set<std::string> kDeclaredExtNames = {TRACETOOLS_EXT_EVENTS(EVENT_NAME)};
#undef EVENT_NAME

std::set<std::string> expected_names(const char* rows) {
  std::set<std::string> names;
  for (const auto& [name, fields] : expected(rows, [](const auto& each, const auto&, const auto&) { return each; })) {
    names.insert(name);
  }
  return names;
}

TEST(EventFunctions, AreThoseOfTheEvents) {
  EXPECT_EQ(kDeclaredNames, expected_names(kEventRows));
  EXPECT_EQ(kDeclaredNames.size(), 42u);
  EXPECT_EQ(kDeclaredExtNames, expected_names(kExtEventRows));
}

}  // namespace
