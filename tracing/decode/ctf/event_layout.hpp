// SPDX-License-Identifier: Apache-2.0
// The layout of the events of one stream of a trace, found once from its declarations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "tracing/decode/ctf/structure_decoder.hpp"
#include "tracing/decode/ctf/trace_class.hpp"

namespace tracing::ctf {

// Where an event header has its number and its time. LTTng has two forms of a header in one stream: a short one, and a
// long one for large numbers and for events long after the previous event.
struct HeaderLayout {
  struct Number {
    std::uint32_t bit = 0;   // from the beginning of the header
    std::uint32_t size = 0;  // bits; 0: there is none
  };
  struct Form {
    Number id;
    Number time;
    std::uint32_t end = 0;  // bits
  };
  std::uint32_t alignment = 8;
  bool is_big_endian = false;
  Number first_id;  // gives the form, and in the short form the number of the event
  bool has_long_form = false;
  std::uint64_t long_first = 0;  // the values of first_id that mean the long form
  std::uint64_t long_last = 0;
  Form short_form;
  Form long_form;
  std::string clock;
};

struct EventLayout {
  static constexpr std::size_t kMostSimpleFields = 256;
  EventLayout(const EventDeclaration& event, std::size_t number)
      : declaration(event), index(number), context(event.context), payload(event.payload) {}
  const EventDeclaration& declaration;
  std::size_t index;  // of the declaration in the trace
  StructureDecoder context;
  StructureDecoder payload;
  // The contexts of the stream, those of the event, and the payload are simple and have not too many fields.
  bool is_simple = false;
  // If these three are simple and their size never differs: the bytes of all, and where the contexts of the event and
  // the payload begin.
  std::optional<std::uint32_t> fixed_size;
  std::uint32_t context_offset = 0;
  std::uint32_t payload_offset = 0;
};

// The usual event, for which two words of its header and a table tell all: its header has the short form and begins at
// any byte, and all that follows has a size of its own.
struct UsualHeader {
  bool is_known = false;  // the stream has such headers
  std::uint32_t id_shift = 0;
  std::uint32_t time_byte = 0;  // where the word with the time begins
  std::uint32_t time_shift = 0;
  std::uint64_t id_mask = 0;
  std::uint64_t time_mask = 0;
};
struct UsualEvent {
  const EventLayout* layout = nullptr;  // null: events of this number are not usual
  std::uint32_t header_bytes = 0;
  std::uint32_t bytes = 0;  // with the header
  std::uint32_t context_offset = 0;
  std::uint32_t payload_offset = 0;
};

class StreamLayout {
 public:
  // The trace must outlive the layout. Throws UnsupportedTrace.
  StreamLayout(const TraceClass& trace, const StreamDeclaration& stream);

  const HeaderLayout& header() const { return header_; }
  const UsualHeader& usual_header() const { return usual_header_; }
  const std::vector<UsualEvent>& usual_events() const { return usual_events_; }  // by number
  const Clock& clock() const { return *clock_; }
  const StructureDecoder& event_context() const { return event_context_; }
  // Null when no event has this number.
  const EventLayout* event(std::uint64_t id) const {
    if (id < dense_.size()) {
      return dense_[id].get();
    }
    const auto found = sparse_.find(id);
    return found == sparse_.end() ? nullptr : found->second.get();
  }

 private:
  void find_usual_events();

  HeaderLayout header_;
  UsualHeader usual_header_;
  std::vector<UsualEvent> usual_events_;
  const Clock* clock_ = nullptr;
  StructureDecoder event_context_;
  std::vector<std::unique_ptr<EventLayout>> dense_;  // by number
  std::unordered_map<std::uint64_t, std::unique_ptr<EventLayout>> sparse_;
};

}  // namespace tracing::ctf
