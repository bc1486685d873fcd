// SPDX-License-Identifier: Apache-2.0
// libbabeltrace2 for C++: owned references, its errors as exceptions, and a graph that gives messages. Private to the
// reader.
#pragma once

#include <babeltrace2/babeltrace.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tracing::babeltrace {

template <class T, void (*put)(const T*)>
struct PutReference {
  void operator()(const T* object) const { put(object); }
};

using Graph = std::unique_ptr<bt_graph, PutReference<bt_graph, bt_graph_put_ref>>;
using Plugin = std::unique_ptr<const bt_plugin, PutReference<bt_plugin, bt_plugin_put_ref>>;
using Value = std::unique_ptr<bt_value, PutReference<bt_value, bt_value_put_ref>>;
using ConstValue = std::unique_ptr<const bt_value, PutReference<bt_value, bt_value_put_ref>>;
using QueryExecutor = std::unique_ptr<bt_query_executor, PutReference<bt_query_executor, bt_query_executor_put_ref>>;
using Message = std::unique_ptr<const bt_message, PutReference<bt_message, bt_message_put_ref>>;
using StreamReference = std::unique_ptr<const bt_stream, PutReference<bt_stream, bt_stream_put_ref>>;
using EventClassReference = std::unique_ptr<const bt_event_class, PutReference<bt_event_class, bt_event_class_put_ref>>;

// Throws a TraceReadError with the causes that the library has noted for this thread, and clears them. `what` is the
// start of the message; the library's own innermost reason is appended.
[[noreturn]] void throw_noted_error(const std::string& what, const std::string& remedy);

// For calls that fail only when memory is short or the library is used wrongly.
void check(int status, const char* call);

// Throws TraceReadError when the plugin is not installed. By default the library prints nothing.
Plugin find_plugin(const char* name);
// Looks first where the other plugin was found: a search of all directories takes milliseconds.
Plugin find_plugin_beside(const Plugin& other, const char* name);

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
