// The events of ROS 2, compared with what LTTng wrote and babeltrace2 reads: neither is ours.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tracetools/tracetools.h"

namespace {

using test_support::run_command;

// Event: its fields, each with type and the value that fire_all_events.cpp gives.
constexpr const char* kEvents = R"rows(
rcl_init: context_handle ptr 0x1, version str "8.10.1"
rcl_node_init: node_handle ptr 0x1, rmw_handle ptr 0x2, node_name str "ping", namespace str "/robot"
rmw_publisher_init: rmw_publisher_handle ptr 0x1, gid gid GID
rcl_publisher_init: publisher_handle ptr 0x1, node_handle ptr 0x2, rmw_publisher_handle ptr 0x3, topic_name str "/ping", queue_depth u64 10
rclcpp_publish: message ptr 0x2
rclcpp_intra_publish: publisher_handle ptr 0x1, message ptr 0x2
rcl_publish: publisher_handle ptr 0x1, message ptr 0x2
rmw_publish: rmw_publisher_handle ptr 0x1, message ptr 0x2, timestamp i64 1767225600506920000
rmw_subscription_init: rmw_subscription_handle ptr 0x1, gid gid GID
rcl_subscription_init: subscription_handle ptr 0x1, node_handle ptr 0x2, rmw_subscription_handle ptr 0x3, topic_name str "/pong", queue_depth u64 5
rclcpp_subscription_init: subscription_handle ptr 0x1, subscription ptr 0x2
rclcpp_subscription_callback_added: subscription ptr 0x1, callback ptr 0x2
rmw_take: rmw_subscription_handle ptr 0x1, message ptr 0xFFFFFFFFFFFFFFFF, source_timestamp i64 -1, taken bool 1
rcl_take: message ptr 0x1
rclcpp_take: message ptr 0x1
rcl_service_init: service_handle ptr 0x1, node_handle ptr 0x2, rmw_service_handle ptr 0x3, service_name str "/add"
rclcpp_service_callback_added: service_handle ptr 0x1, callback ptr 0x2
rmw_take_request: rmw_service_handle ptr 0x1, request ptr 0x2, client_gid gid GID, sequence_number i64 3, taken bool 0
rmw_send_response: rmw_service_handle ptr 0x1, response ptr 0x2, client_gid gid GID, sequence_number i64 3, timestamp i64 4
rmw_client_init: rmw_client_handle ptr 0x1, gid gid GID
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
message_link_periodic_async: _subs_length u64 2, subs ptr[_subs_length] [0x51 0x52], _pubs_length u64 1, pubs ptr[_pubs_length] [0x61]
message_link_partial_sync: _subs_length u64 1, subs ptr[_subs_length] [0x51], _pubs_length u64 0, pubs ptr[_pubs_length] []
)rows";

// Fields of an event: "name type" each, in order, or "name = value".
using Fields = std::vector<std::string>;
using EventTable = std::map<std::string, Fields>;

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    if (end > begin) parts.push_back(text.substr(begin, end - begin));
    begin = end + separator.size();
  }
  return parts;
}

// From kEvents, made by `field` from the name, type and value of each field.
template <typename MakeField>
EventTable expected(MakeField field) {
  EventTable table;
  for (const std::string& row : split(kEvents, "\n")) {
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

std::string type_of(const std::string& declaration) {
  static const std::map<std::string, std::string> types = {
      {"integer { size = 64; align = 8; signed = 0; encoding = none; base = 16; }", "ptr"},
      {"integer { size = 64; align = 8; signed = 0; encoding = none; base = 10; }", "u64"},
      {"integer { size = 64; align = 8; signed = 1; encoding = none; base = 10; }", "i64"},
      {"integer { size = 32; align = 8; signed = 1; encoding = none; base = 10; }", "bool"},
      {"integer { size = 8; align = 8; signed = 0; encoding = none; base = 10; }", "u8"},
      {"string", "str"},
  };
  const auto found = types.find(declaration);
  return found == types.end() ? declaration : found->second;
}

// From the trace's metadata in CTF's language: what every reader knows of the events.
EventTable declared_events(const std::string& metadata) {
  EventTable table;
  std::istringstream lines(metadata);
  Fields* fields = nullptr;
  // LTTng puts an underscore before every name, and one more before a length.
  const std::regex event(R"re(\s*name = "ros2:(\w+)";)re");
  const std::regex field(R"re(\t\t(.*) _(\w+)(?:\[ *_?(\w+) *\])?;)re");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, event)) {
      fields = &table[match.str(1)];
    } else if (line == "};") {
      fields = nullptr;
    } else if (fields != nullptr && std::regex_match(line, match, field)) {
      const std::string count = match.str(3).empty() ? "" : "[" + match.str(3) + "]";
      std::string type = type_of(match.str(1)) + count;
      if (type == "u8[16]") type = "gid";
      fields->push_back(match.str(2) + " " + type);
    }
  }
  return table;
}

// What babeltrace2 prints for each event, as "name = value".
EventTable printed_events(const std::string& text) {
  EventTable table;
  std::istringstream lines(text);
  const std::regex event(R"re(.* ros2:(\w+): \{ cpu_id = \d+ \}, \{ (.*?) ?\})re");
  const std::regex index(R"re(\[\d+\] = )re");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, event)) continue;
    std::string payload = std::regex_replace(match.str(2), index, "");
    // Commas inside an array do not separate fields.
    int depth = 0;
    for (char& c : payload) {
      depth += c == '[' ? 1 : c == ']' ? -1 : 0;
      if (depth == 0 && c == ',') c = '\n';
    }
    Fields& fields = table[match.str(1)];
    for (const std::string& field : split(payload, "\n")) {
      fields.push_back(std::regex_replace(field, std::regex(R"(^ )"), ""));
    }
  }
  return table;
}

class RecordedEvents : public testing::Test {
 protected:
  void SetUp() override {
    for (const std::vector<std::string>& argv :
         std::vector<std::vector<std::string>>{{"lttng-sessiond", "--daemonize"},
                                               {"lttng", "create", "payload", "--output=" + trace_.string()},
                                               {"lttng", "enable-event", "--userspace", "ros2:*"},
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
    if (entry.path().filename() == "metadata") folder = entry.path().parent_path();
  }
  const auto metadata = run_command({"babeltrace2", "--output-format=ctf-metadata", folder.string()});
  ASSERT_EQ(metadata.exit_code, 0) << metadata.err;
  EXPECT_EQ(declared_events(metadata.out),
            expected([](const auto& name, const auto& type, const auto&) { return name + " " + type; }));
}

TEST_F(RecordedEvents, HoldTheArgumentsOfTheFunctions) {
  const auto text = run_command({"babeltrace2", trace_.string()});
  ASSERT_EQ(text.exit_code, 0) << text.err;
  EXPECT_EQ(printed_events(text.out), expected([](const auto& name, const auto&, std::string value) {
              value = value == "GID"  ? "[ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 30, 255 ]"
                      : value == "[]" ? "[ ]"
                                      : value;
              if (value[0] == '[' && value.find(',') == std::string::npos && value != "[ ]") {
                value = "[ " + std::regex_replace(value.substr(1, value.size() - 2), std::regex(" "), ", ") + " ]";
              }
              return name + " = " + value;
            }));
}

#define EVENT_NAME(name, ...) #name,
const std::set<std::string> kDeclaredNames = {TRACETOOLS_EVENTS(EVENT_NAME)};
#undef EVENT_NAME

TEST(EventFunctions, AreThoseOfTheEvents) {
  std::set<std::string> names;
  for (const auto& [name, fields] : expected([](const auto&name, const auto&, const auto&) { return name; })) {
    names.insert(name);
  }
  EXPECT_EQ(kDeclaredNames, names);
  EXPECT_EQ(names.size(), 42u);
}

// A stack built with one configuration runs with the library of another.
TEST(EventFunctions, AreTheSameWhenTracepointsAreExcluded) {
  void* excluded = dlopen(EXCLUDED_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(excluded, nullptr) << dlerror();
  for (void* library : {excluded, RTLD_DEFAULT}) {
    for (const std::string& name : kDeclaredNames) {
      EXPECT_NE(dlsym(library, ("ros_trace_" + name).c_str()), nullptr) << name;
      EXPECT_NE(dlsym(library, ("ros_trace_do_" + name).c_str()), nullptr) << name;
      EXPECT_NE(dlsym(library, ("ros_trace_enabled_" + name).c_str()), nullptr) << name;
    }
  }
  for (const std::string& name : kDeclaredNames) {
    EXPECT_FALSE(reinterpret_cast<bool (*)()>(dlsym(excluded, ("ros_trace_enabled_" + name).c_str()))()) << name;
  }
  for (const char* status : {"ros_trace_compile_status", "ros_trace_runtime_status"}) {
    EXPECT_FALSE(reinterpret_cast<bool (*)()>(dlsym(excluded, status))()) << status;
  }
  dlclose(excluded);
}

}  // namespace
