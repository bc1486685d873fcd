// SPDX-License-Identifier: Apache-2.0
// The declarations in the metadata of a CTF 1.8 trace: clocks, the environment, streams and events.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "tracing/decode/ctf/field_class.hpp"

namespace tracing::ctf {

// The trace uses something that this decoder does not know. Another reader may know it.
class UnsupportedTrace : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Turns the value of a clock into nanoseconds since the epoch.
struct Clock {
  std::string name;
  std::string uuid;
  std::uint64_t frequency = 1'000'000'000;  // cycles per second
  std::int64_t offset_s = 0;                // time of the value 0 since the epoch: this number of seconds …
  std::int64_t offset = 0;                  // … and this number of cycles

  std::int64_t nanoseconds(std::uint64_t cycles) const;
};

struct EventDeclaration {
  std::string name;
  std::uint64_t id = 0;
  std::uint64_t stream_id = 0;
  FieldClassPtr context;  // of this event alone; null: none
  FieldClassPtr payload;  // null: no fields
};

struct StreamDeclaration {
  std::uint64_t id = 0;
  FieldClassPtr packet_context;  // null: none
  FieldClassPtr event_header;
  FieldClassPtr event_context;  // for all events of the stream; null: none
};

using EnvironmentValue = std::variant<std::int64_t, std::string>;
using Environment = std::map<std::string, EnvironmentValue>;

// The value of an entry that is a text; empty when there is none.
std::string_view environment_text(const Environment& environment, const std::string& name);

struct TraceClass {
  std::string uuid;  // empty: none
  bool is_big_endian = false;
  FieldClassPtr packet_header;  // null: none
  Environment environment;
  std::map<std::string, Clock> clocks;                 // by name
  std::map<std::uint64_t, StreamDeclaration> streams;  // by id
  std::vector<EventDeclaration> events;

  // The value of an entry of the environment that is a number.
  std::optional<std::int64_t> environment_number(const std::string& name) const;
  std::string environment_text(const std::string& name) const {
    return std::string(ctf::environment_text(environment, name));
  }
};

// Reads the text of a metadata file. Throws UnsupportedTrace, with the line, for text that it can't read.
TraceClass parse_metadata(std::string_view text);

}  // namespace tracing::ctf
