// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/live_reader.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <utility>

#include "tracing/decode/reader/babeltrace.hpp"
#include "tracing/decode/reader/message_translator.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"

namespace tracing {

namespace {

using babeltrace::MessageGraph;
using Clock = std::chrono::steady_clock;

constexpr const char* kNoDaemonRemedy =
    "a live session goes to a relay daemon: start 'lttng-relayd', and give the session a live-timer";

constexpr std::chrono::seconds kLongestFailing{10};  // the time that LTTng has for its description of a process

std::string name_of_this_machine() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

struct KnownSession {
  std::uint64_t streams = 0;
  std::uint64_t viewers = 0;
};

std::uint64_t number(const bt_value* map, const char* key) {
  const bt_value* const value = bt_value_map_borrow_entry_value_const(map, key);
  return value != nullptr && bt_value_is_unsigned_integer(value) ? bt_value_integer_unsigned_get(value) : 0;
}

bool has_text(const bt_value* map, const char* key, const std::string& text) {
  const bt_value* const value = bt_value_map_borrow_entry_value_const(map, key);
  return value != nullptr && bt_value_is_string(value) && bt_value_string_get(value) == text;
}

// What the relay daemon says of the session; nullopt when it does not have it.
std::optional<KnownSession> ask_relay(const bt_component_class_source* lttng_live, const LiveAddress& address) {
  const babeltrace::Value parameters(bt_value_map_create());
  const std::string relay = "net://" + address.relay;
  babeltrace::check(bt_value_map_insert_string_entry(parameters.get(), "url", relay.c_str()), "bt_value_map_insert");
  const babeltrace::QueryExecutor query(bt_query_executor_create(
      bt_component_class_source_as_component_class_const(lttng_live), "sessions", parameters.get()));
  const bt_value* answer = nullptr;
  if (bt_query_executor_query(query.get(), &answer) != BT_QUERY_EXECUTOR_QUERY_STATUS_OK) {
    bt_current_thread_clear_error();
    throw TraceReadError(fmt::format("no relay daemon answers at {}", relay), kNoDaemonRemedy);
  }
  const babeltrace::ConstValue owned(answer);
  if (!bt_value_is_array(answer)) {
    return std::nullopt;
  }
  for (std::uint64_t i = 0; i < bt_value_array_get_length(answer); ++i) {
    const bt_value* const session = bt_value_array_borrow_element_by_index_const(answer, i);
    if (!has_text(session, "session-name", address.session) || !has_text(session, "target-hostname", address.host)) {
      continue;
    }
    return KnownSession{number(session, "stream-count"), number(session, "client-count")};
  }
  return std::nullopt;
}

}  // namespace

LiveAddress live_address(const std::string& text) {
  constexpr std::string_view kScheme = "net://";
  LiveAddress address;
  address.host = name_of_this_machine();
  address.session = text;
  if (text.find("://") == std::string::npos) {
    return address;
  }
  const std::size_t host = text.find("/host/", kScheme.size());
  const std::size_t session = host == std::string::npos ? host : text.find('/', host + 6);
  if (!text.starts_with(kScheme) || session == std::string::npos || session + 1 == text.size()) {
    throw TraceReadError(fmt::format("'{}' is no address of a live session", text),
                         "write net://RELAY[:PORT]/host/HOST/SESSION, or the name of a session of this machine");
  }
  address.relay = text.substr(kScheme.size(), host - kScheme.size());
  address.host = text.substr(host + 6, session - host - 6);
  address.session = text.substr(session + 1);
  return address;
}

RelayState ask_relay_daemon(const LiveAddress& address) {
  const MessageGraph graph("lttng-live");
  try {
    return ask_relay(graph.source_class(), address) ? RelayState::kSession : RelayState::kNoSession;
  } catch (const TraceReadError&) {
    return RelayState::kNoDaemon;
  }
}

struct LiveReader::Implementation {
  // One attachment to the session, with what it has read.
  struct Connection {
    MessageGraph graph{"lttng-live"};
    MessageTranslator translator;  // its references must be released before the graph
    std::size_t next_message = 0;
  };

  enum class Attach { kDone, kNoSession, kNotYet };

  Attach attach();
  std::optional<MessageGraph::Fetch> fetch();
  bool may_attach_anew();
  bool has_streams() const;

  LiveAddress address;
  std::string what;
  std::unique_ptr<Connection> connection;  // null: to be made by attach()
  std::size_t late_attachments = 0;
  bool is_at_end = false;
  bool has_given = false;  // an item, by next()
  std::optional<std::int64_t> told_until_ns;
  std::optional<Clock::time_point> first_failure;
  Clock::time_point last_failure;
};

LiveReader::Implementation::Attach LiveReader::Implementation::attach() {
  auto made = std::make_unique<Connection>();
  const std::optional<KnownSession> known = ask_relay(made->graph.source_class(), address);
  if (!known) {
    return Attach::kNoSession;
  }
  if (known->viewers > 0) {
    // The relay daemon may not know yet that the last attachment has ended.
    if (first_failure && may_attach_anew()) {
      return Attach::kNotYet;
    }
    throw TraceReadError(what + ": another viewer has attached to it",
                         "the relay daemon has one viewer for a session; end the other one");
  }
  const babeltrace::Value parameters(bt_value_map_create());
  bt_value* inputs = nullptr;
  babeltrace::check(bt_value_map_insert_empty_array_entry(parameters.get(), "inputs", &inputs), "bt_value_map_insert");
  babeltrace::check(bt_value_array_append_string_element(inputs, address.url().c_str()), "bt_value_array_append");
  babeltrace::check(bt_value_map_insert_string_entry(parameters.get(), "session-not-found-action", "end"),
                    "bt_value_map_insert");
  made->graph.add_source("live", parameters.get(), what, kNoDaemonRemedy);
  connection = std::move(made);
  // The source attaches when it is asked for messages.
  const std::optional<MessageGraph::Fetch> fetched = fetch();
  if (!fetched) {
    return Attach::kNotYet;
  }
  // Streams may have begun after the first question.
  if (known->streams > 0 || has_streams()) {
    ++late_attachments;
  }
  is_at_end = *fetched == MessageGraph::Fetch::kEnd;
  return Attach::kDone;
}

bool LiveReader::Implementation::has_streams() const {
  const std::optional<KnownSession> known = ask_relay(connection->graph.source_class(), address);
  return known && known->streams > 0;
}

// nullopt: the attachment has failed, and another one may succeed.
std::optional<MessageGraph::Fetch> LiveReader::Implementation::fetch() {
  connection->next_message = 0;
  try {
    return connection->graph.fetch(what, "the relay daemon may have ended");
  } catch (const TraceReadError&) {
    if (has_given || !may_attach_anew()) {
      throw;
    }
    connection.reset();
    return std::nullopt;
  }
}

// LTTng describes the events of a process before their stream if the process runs before the session. libbabeltrace2
// fails for good if it reads the events without the stream, so the reader must attach anew. Call this once for each
// failure: it measures how long they go on.
bool LiveReader::Implementation::may_attach_anew() {
  const Clock::time_point now = Clock::now();
  if (!first_failure || now - last_failure > kLongestFailing) {
    first_failure = now;
  }
  last_failure = now;
  return now - *first_failure <= kLongestFailing;
}

LiveReader::LiveReader(LiveAddress address) : implementation_(std::make_unique<Implementation>()) {
  implementation_->what = fmt::format("cannot read the live session '{}'", address.url());
  implementation_->address = std::move(address);
}

LiveReader::~LiveReader() = default;

bool LiveReader::attach() {
  return implementation_->attach() == Implementation::Attach::kDone;
}

std::optional<std::int64_t> LiveReader::told_until_ns() const {
  return implementation_->told_until_ns;
}

std::size_t LiveReader::late_attachments() const {
  return implementation_->late_attachments;
}

LiveReader::State LiveReader::next(TraceItem& item) {
  using Attach = Implementation::Attach;
  Implementation& reader = *implementation_;
  for (;;) {
    if (!reader.connection) {
      const Attach attached = reader.attach();
      if (attached == Attach::kNotYet) {
        return State::kNothingYet;
      }
      if (attached == Attach::kNoSession) {
        return State::kEnd;
      }
    }
    Implementation::Connection& connection = *reader.connection;
    while (connection.next_message < connection.graph.messages().size()) {
      const bt_message* const message = connection.graph.messages()[connection.next_message++].get();
      item = connection.translator.translate(message);
      if (const std::optional<std::int64_t> time =
              item.event != nullptr ? item.event->timestamp_ns : time_of_inactivity(message)) {
        reader.told_until_ns = std::max(reader.told_until_ns.value_or(*time), *time);
      }
      if (!item) {
        continue;
      }
      reader.has_given = true;
      return State::kItem;
    }
    if (reader.is_at_end) {
      return State::kEnd;
    }
    const std::optional<MessageGraph::Fetch> fetched = reader.fetch();
    if (!fetched) {
      continue;
    }
    if (*fetched == MessageGraph::Fetch::kNothingYet) {
      return State::kNothingYet;
    }
    reader.is_at_end = *fetched == MessageGraph::Fetch::kEnd;
  }
}

}  // namespace tracing
