// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/babeltrace.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "tracing/decode/reader/trace_read_error.hpp"

namespace tracing::babeltrace {

void throw_noted_error(const std::string& what, const std::string& remedy) {
  std::string reason;
  std::string details;
  if (const bt_error* error = bt_current_thread_take_error()) {
    for (std::uint64_t i = 0; i < bt_error_get_cause_count(error); ++i) {  // the first cause is the innermost
      const bt_error_cause* cause = bt_error_borrow_cause_by_index(error, i);
      const std::string message = bt_error_cause_get_message(cause);
      if (i == 0) {
        reason = message;
      }
      details.insert(0, fmt::format("{}: {}\n", bt_error_cause_get_module_name(cause), message));
    }
    bt_error_release(error);
  }
  throw TraceReadError(reason.empty() ? what : fmt::format("{}: {}", what, reason), remedy, details);
}

void check(int status, const char* call) {
  constexpr int kOk = BT_GRAPH_RUN_STATUS_OK;  // the same value in every status enumeration of the library
  if (status != kOk) {
    throw_noted_error(fmt::format("libbabeltrace2: {} failed", call), "");
  }
}

Plugin find_plugin(const char* name) {
  const bt_plugin* plugin = nullptr;
  const bt_plugin_find_status status = bt_plugin_find(name, BT_TRUE, BT_TRUE, BT_TRUE, BT_TRUE, BT_FALSE, &plugin);
  if (status != BT_PLUGIN_FIND_STATUS_OK) {
    throw_noted_error(fmt::format("babeltrace2's plugin '{}' was not found", name),
                      "install libbabeltrace2-0, or correct the environment variable BABELTRACE_PLUGIN_PATH");
  }
  return Plugin(plugin);
}

Plugin find_plugin_beside(const Plugin& other, const char* name) {
  const char* const path = bt_plugin_get_path(other.get());
  const std::string directory = path != nullptr ? std::filesystem::path(path).parent_path().string() : std::string();
  const bt_plugin_set* set = nullptr;
  const std::string file = fmt::format("{}/babeltrace-plugin-{}.so", directory, name);
  if (directory.empty() ||
      bt_plugin_find_all_from_file(file.c_str(), BT_FALSE, &set) != BT_PLUGIN_FIND_ALL_FROM_FILE_STATUS_OK) {
    return find_plugin(name);
  }
  const bt_plugin* const plugin = bt_plugin_set_borrow_plugin_by_index_const(set, 0);
  bt_plugin_get_ref(plugin);
  bt_plugin_set_put_ref(set);
  return Plugin(plugin);
}

MessageGraph::MessageGraph(const char* source)
    : ctf_(find_plugin("ctf")),
      utils_(find_plugin_beside(ctf_, "utils")),
      source_class_(bt_plugin_borrow_source_component_class_by_name_const(ctf_.get(), source)) {
  if (source_class_ == nullptr) {
    throw TraceReadError("babeltrace2's plugin 'ctf' has no source '" + std::string(source) + "'",
                         "install libbabeltrace2-0, or correct the environment variable BABELTRACE_PLUGIN_PATH");
  }
}

MessageGraph::~MessageGraph() = default;

void MessageGraph::add_source(const std::string& name, const bt_value* parameters, const std::string& what,
                              const std::string& remedy) {
  if (!graph_) {
    graph_.reset(bt_graph_create(0));
    const auto* muxer_class = bt_plugin_borrow_filter_component_class_by_name_const(utils_.get(), "muxer");
    check(bt_graph_add_filter_component(graph_.get(), muxer_class, "muxer", nullptr, BT_LOGGING_LEVEL_NONE, &muxer_),
          "bt_graph_add_filter_component");
  }
  const bt_component_source* source = nullptr;
  if (bt_graph_add_source_component(graph_.get(), source_class_, name.c_str(), parameters, BT_LOGGING_LEVEL_NONE,
                                    &source) != BT_GRAPH_ADD_COMPONENT_STATUS_OK) {
    throw_noted_error(what, remedy);
  }
  for (std::uint64_t i = 0; i < bt_component_source_get_output_port_count(source); ++i) {
    check(bt_graph_connect_ports(graph_.get(), bt_component_source_borrow_output_port_by_index_const(source, i),
                                 bt_component_filter_borrow_input_port_by_index_const(muxer_, next_input_++), nullptr),
          "bt_graph_connect_ports");
  }
}

bt_graph_simple_sink_component_initialize_func_status MessageGraph::start(bt_message_iterator* iterator, void* data) {
  static_cast<End*>(data)->iterator = iterator;
  return BT_GRAPH_SIMPLE_SINK_COMPONENT_INITIALIZE_FUNC_STATUS_OK;
}

bt_graph_simple_sink_component_consume_func_status MessageGraph::consume(bt_message_iterator* iterator, void* data) {
  bt_message_array_const messages = nullptr;
  std::uint64_t count = 0;
  const bt_message_iterator_next_status status = bt_message_iterator_next(iterator, &messages, &count);
  if (status != BT_MESSAGE_ITERATOR_NEXT_STATUS_OK) {
    return static_cast<bt_graph_simple_sink_component_consume_func_status>(status);  // the same values by design
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    static_cast<End*>(data)->messages.emplace_back(messages[i]);
  }
  return BT_GRAPH_SIMPLE_SINK_COMPONENT_CONSUME_FUNC_STATUS_OK;
}

void MessageGraph::add_end() {
  has_end_ = true;
  const bt_component_sink* sink = nullptr;
  check(bt_graph_add_simple_sink_component(graph_.get(), "sink", start, consume, nullptr, &end_, &sink),
        "bt_graph_add_simple_sink_component");
  check(bt_graph_connect_ports(graph_.get(), bt_component_filter_borrow_output_port_by_index_const(muxer_, 0),
                               bt_component_sink_borrow_input_port_by_index_const(sink, 0), nullptr),
        "bt_graph_connect_ports");
}

MessageGraph::Fetch MessageGraph::fetch(const std::string& what, const std::string& remedy) {
  if (next_input_ == 0) {
    return Fetch::kEnd;  // no source has a stream
  }
  if (!has_end_) {
    add_end();
  }
  end_.messages.clear();
  switch (bt_graph_run_once(graph_.get())) {
    case BT_GRAPH_RUN_ONCE_STATUS_OK:
      return Fetch::kMessages;
    case BT_GRAPH_RUN_ONCE_STATUS_AGAIN:
      return Fetch::kNothingYet;
    case BT_GRAPH_RUN_ONCE_STATUS_END:
      return Fetch::kEnd;
    default:
      throw_noted_error(what, remedy);
  }
}

}  // namespace tracing::babeltrace
