// SPDX-License-Identifier: Apache-2.0
// A graph of libbabeltrace2: sources, a muxer that puts their messages in the order of time, and an end that takes the
// messages. Private to the reader.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/decode/reader/babeltrace.hpp"

namespace tracing::babeltrace {

class MessageGraph {
 public:
  // `source` is the name of a source of the plugin ctf: "fs", "lttng-live".
  explicit MessageGraph(const char* source);
  ~MessageGraph();

  const bt_component_class_source* source_class() const { return source_class_; }

  // Before the first fetch(). The errors begin with `what`. Throws TraceReadError.
  void add_source(const std::string& name, const bt_value* parameters, const std::string& what,
                  const std::string& remedy);

  enum class Fetch { kMessages, kNothingYet, kEnd };
  // Replaces the messages by the next ones. Throws TraceReadError.
  Fetch fetch(const std::string& what, const std::string& remedy);
  const std::vector<Message>& messages() const { return end_.messages; }

 private:
  // Where the messages arrive, some at a time.
  struct End {
    bt_message_iterator* iterator = nullptr;
    std::vector<Message> messages;
  };
  static bt_graph_simple_sink_component_initialize_func_status start(bt_message_iterator* iterator, void* data);
  static bt_graph_simple_sink_component_consume_func_status consume(bt_message_iterator* iterator, void* data);
  void add_end();

  Plugin ctf_;
  Plugin utils_;
  const bt_component_class_source* source_class_;
  Graph graph_;
  const bt_component_filter* muxer_ = nullptr;
  std::uint64_t next_input_ = 0;  // the muxer adds a free input port whenever its last one is connected
  bool has_end_ = false;
  End end_;  // its messages must be released before the graph
};

}  // namespace tracing::babeltrace
