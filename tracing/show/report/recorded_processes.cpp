// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/recorded_processes.hpp"

#include <nlohmann/json.hpp>

namespace tracing {
namespace {

// "/robot/talker" of a ros2:rcl_node_init.
std::string node_name(const Event& event) {
  const auto text = [&event](const char* field) {
    const std::optional<FieldValue> value = event.field(field);
    return std::string(value ? value->string().value_or("") : "");
  };
  const std::string space = text("namespace");
  return space + (space.ends_with('/') ? "" : "/") + text("node_name");
}

}  // namespace

void RecordedProcessCounter::on_event(const Event& event) {
  if (!event.vpid) {
    return;
  }
  const auto [found, is_new] = processes_.try_emplace(*event.vpid);
  Process& process = found->second;
  if (is_new) {
    process.begin_ns = event.timestamp_ns;
  }
  process.end_ns = event.timestamp_ns;
  if (event.procname && process.name != *event.procname) {
    process.name = *event.procname;
  }
  ++process.events[event.event_class];
  if (event.name() == "ros2:rcl_node_init") {
    process.nodes.insert(node_name(event));
  }
}

std::string RecordedProcessCounter::json() const {
  nlohmann::ordered_json processes = nlohmann::ordered_json::array();
  for (const auto& [vpid, process] : processes_) {
    std::map<std::string, std::uint64_t> events;  // several traces may have classes of one name
    for (const auto& [event_class, count] : process.events) {
      events[event_class->name] += count;
    }
    processes.push_back({{"vpid", vpid},
                         {"name", process.name},
                         {"seconds", static_cast<double>(process.end_ns - process.begin_ns) / 1e9},
                         {"nodes", process.nodes},
                         {"events", events}});
  }
  return nlohmann::ordered_json{{"processes", processes}}.dump(-1, ' ', false,
                                                               nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace tracing
