// SPDX-License-Identifier: Apache-2.0
#include "tracing/reader/babeltrace_reader.hpp"

#include <fmt/format.h>

#include <exception>

#include "tracing/reader/babeltrace.hpp"
#include "tracing/reader/message_translator.hpp"
#include "tracing/reader/trace_discovery.hpp"

namespace tracing {

namespace fs = std::filesystem;

struct BabeltraceReader::Implementation {
  fs::path directory;
  babeltrace::Plugin ctf = babeltrace::find_plugin("ctf");
  babeltrace::Plugin utils = babeltrace::find_plugin_beside(ctf, "utils");
  std::vector<TraceDirectories> traces;
  MessageTranslator translator;
};

namespace {

// What the end of the graph needs: the receiver of the events, and the error that occurred there.
struct Consumer {
  bt_message_iterator* iterator = nullptr;
  MessageTranslator& translator;
  TraceSink& sink;
  std::exception_ptr failure;  // must not pass through the C library, so it stays here until the graph has returned
};

bt_graph_simple_sink_component_initialize_func_status start_consuming(bt_message_iterator* iterator, void* data) {
  static_cast<Consumer*>(data)->iterator = iterator;
  return BT_GRAPH_SIMPLE_SINK_COMPONENT_INITIALIZE_FUNC_STATUS_OK;
}

bt_graph_simple_sink_component_consume_func_status consume(bt_message_iterator* iterator, void* data) {
  Consumer& consumer = *static_cast<Consumer*>(data);
  bt_message_array_const messages = nullptr;
  std::uint64_t count = 0;
  const bt_message_iterator_next_status status = bt_message_iterator_next(iterator, &messages, &count);
  if (status != BT_MESSAGE_ITERATOR_NEXT_STATUS_OK) {
    return static_cast<bt_graph_simple_sink_component_consume_func_status>(status);  // the same values by design
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    const babeltrace::Message message(messages[i]);  // all messages must be released, even after a failure
    if (consumer.failure) continue;
    try {
      consumer.translator.translate(message.get(), consumer.sink);
    } catch (...) {
      consumer.failure = std::current_exception();
    }
  }
  return consumer.failure ? BT_GRAPH_SIMPLE_SINK_COMPONENT_CONSUME_FUNC_STATUS_ERROR
                          : BT_GRAPH_SIMPLE_SINK_COMPONENT_CONSUME_FUNC_STATUS_OK;
}

const bt_component_source* add_source(bt_graph* graph, const bt_component_class_source* ctf_fs,
                                      const TraceDirectories& directories) {
  const babeltrace::Value parameters(bt_value_map_create());
  bt_value* inputs = nullptr;
  babeltrace::check(bt_value_map_insert_empty_array_entry(parameters.get(), "inputs", &inputs), "bt_value_map_insert");
  for (const fs::path& directory : directories) {
    babeltrace::check(bt_value_array_append_string_element(inputs, directory.c_str()), "bt_value_array_append");
  }
  const bt_component_source* source = nullptr;
  if (bt_graph_add_source_component(graph, ctf_fs, directories.front().c_str(), parameters.get(), BT_LOGGING_LEVEL_NONE,
                                    &source) != BT_GRAPH_ADD_COMPONENT_STATUS_OK) {
    babeltrace::throw_noted_error(fmt::format("cannot read the trace '{}'", directories.front().string()),
                                  "a file of it is incomplete or not CTF 1.8: a full disk or a killed session daemon "
                                  "leaves such a trace");
  }
  return source;
}

}  // namespace

BabeltraceReader::BabeltraceReader(const fs::path& directory, const std::vector<fs::path>& traces)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->directory = directory;
  implementation_->traces = group_by_identity(
      bt_plugin_borrow_source_component_class_by_name_const(implementation_->ctf.get(), "fs"), traces);
}

BabeltraceReader::~BabeltraceReader() = default;

void BabeltraceReader::read(TraceSink& sink) {
  Consumer consumer{nullptr, implementation_->translator, sink, nullptr};
  const babeltrace::Graph graph(bt_graph_create(0));
  const auto* ctf_fs = bt_plugin_borrow_source_component_class_by_name_const(implementation_->ctf.get(), "fs");
  const auto* muxer_class =
      bt_plugin_borrow_filter_component_class_by_name_const(implementation_->utils.get(), "muxer");

  const bt_component_filter* muxer = nullptr;
  babeltrace::check(
      bt_graph_add_filter_component(graph.get(), muxer_class, "muxer", nullptr, BT_LOGGING_LEVEL_NONE, &muxer),
      "bt_graph_add_filter_component");
  std::uint64_t next_input = 0;  // the muxer adds a free input port whenever its last one is connected
  for (const TraceDirectories& directories : implementation_->traces) {
    const bt_component_source* source = add_source(graph.get(), ctf_fs, directories);
    for (std::uint64_t i = 0; i < bt_component_source_get_output_port_count(source); ++i) {
      babeltrace::check(
          bt_graph_connect_ports(graph.get(), bt_component_source_borrow_output_port_by_index_const(source, i),
                                 bt_component_filter_borrow_input_port_by_index_const(muxer, next_input++), nullptr),
          "bt_graph_connect_ports");
    }
  }
  if (next_input == 0) return;  // metadata without a stream: a session in which nothing happened

  const bt_component_sink* end = nullptr;
  babeltrace::check(
      bt_graph_add_simple_sink_component(graph.get(), "sink", start_consuming, consume, nullptr, &consumer, &end),
      "bt_graph_add_simple_sink_component");
  babeltrace::check(bt_graph_connect_ports(graph.get(), bt_component_filter_borrow_output_port_by_index_const(muxer, 0),
                                           bt_component_sink_borrow_input_port_by_index_const(end, 0), nullptr),
                    "bt_graph_connect_ports");

  if (bt_graph_run(graph.get()) != BT_GRAPH_RUN_STATUS_OK) {
    if (consumer.failure) {
      bt_current_thread_clear_error();
      std::rethrow_exception(consumer.failure);
    }
    babeltrace::throw_noted_error(
        fmt::format("the trace '{}' is damaged or ends early", implementation_->directory.string()),
        "what comes before the damage was read");
  }
}

}  // namespace tracing
