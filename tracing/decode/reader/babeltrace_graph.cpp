// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/babeltrace_graph.hpp"

#include "tracing/decode/reader/trace_read_error.hpp"

namespace tracing::babeltrace {

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
