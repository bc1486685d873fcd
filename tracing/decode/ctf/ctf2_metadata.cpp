// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/ctf2_metadata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "tracing/decode/ctf/trace_class.hpp"

namespace tracing::ctf {

namespace {

using Json = nlohmann::ordered_json;

constexpr char kRecordSeparator = '\x1e';

// A field class: what stands before the name of a field, and behind it.
struct Declarator {
  std::string type;
  std::string suffix = {};
};

constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kRoles{
    {{"packet-magic-number", "magic"},
     {"metadata-stream-uuid", "uuid"},
     {"data-stream-class-id", "stream_id"},
     {"data-stream-id", "stream_instance_id"},
     {"packet-total-length", "packet_size"},
     {"packet-content-length", "content_size"},
     {"packet-end-default-clock-timestamp", "timestamp_end"},
     {"discarded-event-record-counter-snapshot", "events_discarded"},
     {"packet-sequence-number", "packet_seq_num"},
     {"event-record-class-id", "id"}}};

std::string in_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
      continue;
    }
    if (c == '"' || c == '\\') {
      result += '\\';
    }
    result += c;
  }
  return result + '"';
}

// LTTng puts an underscore in front, which the reader of CTF 1.8 takes away. So no name is a word of the language.
std::string name_of(const std::string& name) {
  std::string result = "_" + name;
  std::replace_if(
      result.begin(), result.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '_'; }, '_');
  return result;
}

std::string text_of(const Json& json, const char* key, const std::string& otherwise = "") {
  return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : otherwise;
}

std::uint64_t number_of(const Json& json, const char* key, std::uint64_t otherwise) {
  return json.contains(key) && json[key].is_number() ? json[key].get<std::uint64_t>() : otherwise;
}

const Json& members_of(const Json& structure) {
  static const Json kNone = Json::array();
  const auto members = structure.find("member-classes");
  return members == structure.end() ? kNone : *members;
}

bool has_role(const Json& type, std::string_view role) {
  return type.contains("roles") && std::find(type["roles"].begin(), type["roles"].end(), role) != type["roles"].end();
}

class Translator {
 public:
  void add(const Json& fragment) {
    const std::string type = text_of(fragment, "type");
    if (type == "preamble") {
      if (number_of(fragment, "version", 0) != 2) {
        throw UnsupportedTrace("the metadata are not CTF 2");
      }
      if (fragment.contains("uuid")) {
        for (const Json& byte : fragment["uuid"]) {
          uuid_ += fmt::format("{:02x}", byte.get<unsigned>());
        }
      }
    } else if (type == "field-class-alias") {
      aliases_[text_of(fragment, "name")] = fragment.at("field-class");
    } else if (type == "trace-class") {
      add_trace(fragment);
    } else if (type == "clock-class") {
      add_clock(fragment);
    } else if (type == "data-stream-class") {
      add_stream(fragment);
    } else if (type == "event-record-class") {
      add_event(fragment);
    }
  }

  std::string text() const {
    std::string trace = trace_;
    if (trace.empty()) {
      trace = block("trace", "major = 1;\nminor = 8;\nbyte_order = le;\n");
    }
    return "/* CTF 1.8 */\n" + trace + rest_;
  }

 private:
  static std::string block(const char* name, const std::string& content) {
    return fmt::format("{} {{\n{}}};\n", name, content);
  }

  void add_trace(const Json& trace) {
    std::string uuid = text_of(trace, "uid", uuid_);
    const bool is_big = trace.dump().find("\"big-endian\"") != std::string::npos;
    std::string content = fmt::format("major = 1;\nminor = 8;\nbyte_order = {};\n", is_big ? "be" : "le");
    if (!uuid.empty()) {
      content += fmt::format("uuid = {};\n", in_quotes(uuid));
    }
    content += member("packet.header", trace, "packet-header-field-class");
    trace_ = block("trace", content);
    if (!trace.contains("environment")) {
      return;
    }
    std::string environment;
    for (const auto& [name, value] : trace["environment"].items()) {
      environment += fmt::format("{} = {};\n", name_of(name).substr(1),
                                 value.is_string() ? in_quotes(value.get<std::string>()) : value.dump());
    }
    rest_ += block("env", environment);
  }

  void add_clock(const Json& clock) {
    const std::string id = text_of(clock, "id", text_of(clock, "name"));
    const Json origin = clock.value("offset-from-origin", Json::object());
    rest_ +=
        block("clock", fmt::format("name = {};\nuuid = {};\nfreq = {};\noffset_s = {};\noffset = {};\n",
                                   in_quotes(clock_name(id)), in_quotes(text_of(clock, "uid", id)),
                                   number_of(clock, "frequency", 1'000'000'000),
                                   origin.value("seconds", std::int64_t{0}), origin.value("cycles", std::int64_t{0})));
  }

  void add_stream(const Json& stream) {
    clock_ = clock_name(text_of(stream, "default-clock-class-id"));
    time_ = "timestamp";
    std::string content = fmt::format("id = {};\n", number_of(stream, "id", 0));
    content += member("event.header", stream, "event-record-header-field-class");
    time_ = "timestamp_begin";
    content += member("packet.context", stream, "packet-context-field-class");
    content += member("event.context", stream, "event-record-common-context-field-class");
    rest_ += block("stream", content);
  }

  void add_event(const Json& event) {
    std::string content = fmt::format("name = {};\nid = {};\nstream_id = {};\n", in_quotes(text_of(event, "name")),
                                      number_of(event, "id", 0), number_of(event, "data-stream-class-id", 0));
    content += member("context", event, "specific-context-field-class");
    content += member("fields", event, "payload-field-class");
    rest_ += block("event", content);
  }

  // Clocks are known by their names in CTF 1.8, which are words.
  static std::string clock_name(const std::string& id) { return "clock" + name_of(id); }

  std::string member(const char* name, const Json& fragment, const char* key) {
    if (!fragment.contains(key)) {
      return "";
    }
    const Json& type = resolved(fragment[key]);
    selected_.clear();
    collect_selectors(type);
    const Declarator declarator = declare(type, "");
    return fmt::format("{} := {}{};\n", name, declarator.type, declarator.suffix);
  }

  const Json& resolved(const Json& type) const {
    if (!type.is_string()) {
      return type;
    }
    const auto alias = aliases_.find(type.get<std::string>());
    if (alias == aliases_.end()) {
      throw UnsupportedTrace(fmt::format("the metadata have no field class '{}'", type.get<std::string>()));
    }
    return alias->second;
  }

  // The last name on the way to a field, where CTF 1.8 finds it from the inside outwards.
  static std::string location_of(const Json& type, const char* key) {
    const Json& path = type.at(key).at("path");
    if (path.empty() || !path.back().is_string()) {
      throw UnsupportedTrace("the metadata refer to a field without a name");
    }
    return path.back().get<std::string>();
  }

  // A variant is selected by labels in CTF 1.8. Its selector therefore becomes an enumeration of its options.
  void collect_selectors(const Json& unresolved) {
    const Json& type = resolved(unresolved);
    const std::string kind = text_of(type, "type");
    if (kind == "variant") {
      selected_[location_of(type, "selector-field-location")] = &type;
      for (const Json& option : type.at("options")) {
        collect_selectors(option.at("field-class"));
      }
    } else if (kind == "structure") {
      for (const Json& one : members_of(type)) {
        collect_selectors(one.at("field-class"));
      }
    } else if (type.contains("element-field-class")) {
      collect_selectors(type["element-field-class"]);
    }
  }
  std::string field_name(const std::string& name, const Json& type) const {
    if (has_role(type, "default-clock-timestamp")) {
      return time_;
    }
    for (const auto& [role, known] : kRoles) {
      if (has_role(type, role)) {
        return std::string(known);
      }
    }
    return name_of(name);
  }

  Declarator declare(const Json& unresolved, const std::string& name) {
    const Json& type = resolved(unresolved);
    const std::string kind = text_of(type, "type");
    if (kind == "structure") {
      return {structure(type)};
    }
    if (kind == "variant") {
      return {variant(type)};
    }
    if (kind == "null-terminated-string") {
      return {"string"};
    }
    if (kind == "static-length-string" || kind == "dynamic-length-string") {
      return {"integer { size = 8; align = 8; signed = 0; encoding = UTF8; }", length(type)};
    }
    if (kind == "static-length-blob" || kind == "dynamic-length-blob") {
      return {"integer { size = 8; align = 8; signed = 0; }", length(type)};
    }
    if (kind == "static-length-array" || kind == "dynamic-length-array") {
      if (number_of(type, "minimum-alignment", 1) > 1) {
        throw UnsupportedTrace("the metadata have an array with an alignment of its own");
      }
      const Declarator element = declare(type.at("element-field-class"), "");
      return {element.type, length(type) + element.suffix};
    }
    return {number(type, kind, name)};
  }

  static std::string length(const Json& type) {
    if (type.contains("length")) {
      return fmt::format("[{}]", type["length"].get<std::uint64_t>());
    }
    return fmt::format("[{}]", name_of(location_of(type, "length-field-location")));
  }

  std::string structure(const Json& type) {
    std::string members;
    for (const Json& one : members_of(type)) {
      const std::string name = text_of(one, "name");
      const Json& of = resolved(one.at("field-class"));
      const Declarator declarator = declare(of, name);
      members += fmt::format("{} {}{};\n", declarator.type, field_name(name, of), declarator.suffix);
    }
    const std::uint64_t alignment = number_of(type, "minimum-alignment", 1);
    return fmt::format("struct {{\n{}}}{}", members, alignment > 1 ? fmt::format(" align({})", alignment) : "");
  }

  std::string variant(const Json& type) {
    const std::string selector = location_of(type, "selector-field-location");
    std::string options;
    std::size_t number = 0;
    for (const Json& option : type.at("options")) {
      const Declarator declarator = declare(option.at("field-class"), "");
      options += fmt::format("{} {}{};\n", declarator.type, option_name(option, number++), declarator.suffix);
    }
    const std::string tag = is_header_id(selector) ? "id" : name_of(selector);
    return fmt::format("variant <{}> {{\n{}}}", tag, options);
  }

  bool is_header_id(const std::string& selector) const { return header_ids_.contains(selector); }

  static std::string option_name(const Json& option, std::size_t number) {
    return name_of(text_of(option, "name", fmt::format("option{}", number)));
  }

  static std::string ranges(const std::string& label, const Json& list) {
    std::string text;
    for (const Json& range : list) {
      text += fmt::format("{} = {} ... {},\n", in_quotes(label), range.at(0).dump(), range.at(1).dump());
    }
    return text;
  }

  std::string number(const Json& type, const std::string& kind, const std::string& name) {
    const std::uint64_t size = number_of(type, "length", 0);
    const std::string order = text_of(type, "byte-order") == "big-endian" ? "be" : "le";
    const std::uint64_t alignment = number_of(type, "alignment", 1);
    if (text_of(type, "bit-order", order == "be" ? "last-to-first" : "first-to-last") !=
        (order == "be" ? "last-to-first" : "first-to-last")) {
      throw UnsupportedTrace("the metadata have a bit order that differs from the byte order");
    }
    if (kind == "fixed-length-floating-point-number") {
      return fmt::format("floating_point {{ exp_dig = {}; mant_dig = {}; align = {}; byte_order = {}; }}",
                         size == 32 ? 8 : 11, size == 32 ? 24 : size - 11, alignment, order);
    }
    if (!kind.starts_with("fixed-length-")) {
      throw UnsupportedTrace(fmt::format("the metadata have a field class '{}'", kind));
    }
    if (has_role(type, "event-record-class-id")) {
      header_ids_.insert(name);
    }
    const bool is_time =
        has_role(type, "default-clock-timestamp") || has_role(type, "packet-end-default-clock-timestamp");
    const std::string integer =
        fmt::format("integer {{ size = {}; align = {}; signed = {}; byte_order = {}; base = {};{} }}", size, alignment,
                    kind == "fixed-length-signed-integer" ? 1 : 0, order, number_of(type, "preferred-display-base", 10),
                    is_time && !clock_.empty() ? fmt::format(" map = clock.{}.value;", clock_) : "");
    std::string labels;
    if (const auto variant = selected_.find(name); !name.empty() && variant != selected_.end()) {
      std::size_t place = 0;
      for (const Json& option : variant->second->at("options")) {
        labels += ranges(option_name(option, place++).substr(1), option.at("selector-field-ranges"));
      }
    } else if (type.contains("mappings")) {
      for (const auto& [label, list] : type["mappings"].items()) {
        labels += ranges(label, list);
      }
    }
    return labels.empty() ? integer : fmt::format("enum : {} {{\n{}}}", integer, labels);
  }

  std::string uuid_;
  std::string trace_;
  std::string rest_;
  std::map<std::string, Json> aliases_;
  std::string clock_;                            // of the stream that is told
  std::string time_ = "timestamp";               // what the time of the default clock is called there
  std::map<std::string, const Json*> selected_;  // variants by the names of their selectors
  std::set<std::string> header_ids_;             // names of fields that are the number of the event
};

}  // namespace

bool is_ctf2_metadata(std::string_view bytes) {
  return !bytes.empty() && (bytes.front() == kRecordSeparator || bytes.front() == '{');
}

Ctf2Metadata translate_ctf2(std::string_view bytes) {
  Ctf2Metadata result;
  Translator translator;
  while (!bytes.empty()) {
    const std::size_t next = bytes.find(kRecordSeparator, 1);
    std::string_view fragment = bytes.substr(0, next);
    bytes = next == std::string_view::npos ? std::string_view() : bytes.substr(next);
    if (fragment.front() == kRecordSeparator) {
      fragment.remove_prefix(1);
    }
    const Json json = Json::parse(fragment, nullptr, false);
    if (!json.is_object()) {
      result.is_cut = true;
      break;
    }
    try {
      translator.add(json);
    } catch (const Json::exception& error) {
      throw UnsupportedTrace(fmt::format("the metadata of CTF 2 lack something: {}", error.what()));
    }
  }
  result.text = translator.text();
  return result;
}

}  // namespace tracing::ctf
