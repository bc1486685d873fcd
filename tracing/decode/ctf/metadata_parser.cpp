// SPDX-License-Identifier: Apache-2.0
// Reads the blocks of metadata, as far as tracers use them: the trace, its environment, clocks, streams and events.
#include <fmt/format.h>

#include <utility>

#include "tracing/decode/ctf/basic_types.hpp"
#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/decode/ctf/tsdl_cursor.hpp"
#include "tracing/decode/ctf/type_parser.hpp"

namespace tracing::ctf {
namespace {

// The byte order of the trace. It is needed first: types may be declared before the block `trace`, which gives it.
bool find_byte_order(const std::vector<Token>& tokens) {
  for (std::size_t i = 0; i + 2 < tokens.size(); ++i) {
    if (tokens[i].is("byte_order") && tokens[i + 1].is("=") && tokens[i + 2].text != "native") {
      return is_big_endian(tokens[i + 2].text, false, tokens[i].line);
    }
  }
  return false;
}

// What an entry of a block says, by the kind of what it declares.
void set(std::string& text, const TsdlEntry& entry) {
  text = entry.value.text;
}
void set(std::uint64_t& number, const TsdlEntry& entry) {
  number = number_of(entry);
}
void set(std::int64_t& number, const TsdlEntry& entry) {
  number = entry.value.number;
}
// Headers, contexts and fields are structures.
void set(FieldClassPtr& type, const TsdlEntry& entry) {
  if (!entry.type || entry.type->kind != FieldKind::kStructure) {
    fail_at_line(entry.line, fmt::format("'{}' is no structure", entry.name));
  }
  type = entry.type;
}

// The entries of a block. Those that nobody takes do not matter.
class Block {
 public:
  explicit Block(std::vector<TsdlEntry> entries) : entries_(std::move(entries)) {}

  // The member keeps its value if there is no such entry.
  template <class Member>
  const Block& take(std::string_view name, Member& member) const {
    for (const TsdlEntry& entry : entries_) {
      if (entry.name == name) {
        set(member, entry);
      }
    }
    return *this;
  }

 private:
  std::vector<TsdlEntry> entries_;
};

class MetadataParser {
 public:
  explicit MetadataParser(std::vector<Token> tokens)
      : trace_{.is_big_endian = find_byte_order(tokens)},
        cursor_(std::move(tokens)),
        types_(cursor_, trace_.is_big_endian) {}

  TraceClass parse() {
    while (cursor_.peek().kind != Token::Kind::kEnd) {
      parse_top_level();
    }
    check_references();
    return std::move(trace_);
  }

 private:
  void parse_top_level() {
    const std::string word = cursor_.at_name() ? cursor_.peek().text : "";
    const bool is_block = cursor_.peek(1).is("{");
    if (cursor_.take_if(";")) {
      return;
    }
    if (word == "typealias") {
      types_.parse_type_alias();
    } else if (word == "typedef") {
      cursor_.fail("typedef is not known here");
    } else if (word == "trace" && is_block) {
      parse_trace();
    } else if (word == "env" && is_block) {
      parse_environment();
    } else if (word == "clock" && is_block) {
      parse_clock();
    } else if (word == "stream" && is_block) {
      parse_stream();
    } else if (word == "event" && is_block) {
      parse_event();
    } else if (word == "callsite" && is_block) {
      types_.parse_block();
    } else {
      types_.parse_type();  // a structure, a variant or an enumeration with a name
      cursor_.expect(";");
    }
  }

  void parse_trace() {
    for (const TsdlEntry& entry : types_.parse_block()) {
      if (entry.name == "uuid") {
        trace_.uuid = entry.value.text;
      }
      if (entry.name == "packet.header") {
        set(trace_.packet_header, entry);
      }
      if ((entry.name == "major" && entry.value.number != 1) || (entry.name == "minor" && entry.value.number != 8)) {
        fail_at_line(entry.line, "not CTF 1.8");
      }
    }
  }

  void parse_environment() {
    for (const TsdlEntry& entry : types_.parse_block()) {
      trace_.environment[entry.name] = entry.value.kind == TsdlValue::Kind::kNumber
                                           ? EnvironmentValue(entry.value.number)
                                           : EnvironmentValue(entry.value.text);
    }
  }

  void parse_clock() {
    Clock clock;
    Block(types_.parse_block())
        .take("name", clock.name)
        .take("uuid", clock.uuid)
        .take("freq", clock.frequency)
        .take("offset_s", clock.offset_s)
        .take("offset", clock.offset);
    if (clock.frequency == 0) {
      cursor_.fail("a clock has the frequency 0");
    }
    trace_.clocks[clock.name] = clock;
  }

  void parse_stream() {
    StreamDeclaration stream;
    Block(types_.parse_block())
        .take("id", stream.id)
        .take("packet.context", stream.packet_context)
        .take("event.header", stream.event_header)
        .take("event.context", stream.event_context);
    trace_.streams[stream.id] = stream;
  }

  void parse_event() {
    EventDeclaration event;
    Block(types_.parse_block())
        .take("name", event.name)
        .take("id", event.id)
        .take("stream_id", event.stream_id)
        .take("context", event.context)
        .take("fields", event.payload);
    trace_.events.push_back(std::move(event));
  }

  void check_references() const {
    for (const EventDeclaration& event : trace_.events) {
      if (!trace_.streams.contains(event.stream_id)) {
        throw UnsupportedTrace(fmt::format("the event '{}' belongs to an unknown stream", event.name));
      }
    }
  }

  TraceClass trace_;
  TsdlCursor cursor_;
  TypeParser types_;
};

}  // namespace

TraceClass parse_metadata(std::string_view text) {
  return MetadataParser(tsdl_tokens(text)).parse();
}

}  // namespace tracing::ctf
