// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/babeltrace_reader.hpp"

#include <fmt/format.h>

#include <fstream>
#include <optional>

#include "tracing/decode/ctf/metadata_text.hpp"
#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/decode/reader/babeltrace.hpp"
#include "tracing/decode/reader/message_translator.hpp"
#include "tracing/decode/reader/trace_discovery.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"

namespace tracing {

namespace fs = std::filesystem;

namespace {

constexpr const char* kDamagedRemedy = "what comes before the damage was read";
constexpr const char* kBesideRemedy = "what can be read beside the damage was read";

// What to do about a trace that nobody can read.
std::string remedy_of(const fs::path& trace) {
  constexpr char kRecordSeparator = '\x1e';  // metadata of CTF 2 are a sequence of JSON texts
  std::ifstream metadata(trace / "metadata", std::ios::binary);
  const auto first = metadata.get();
  if (first == kRecordSeparator || first == '{' || first == '[') {
    return "it is a trace of CTF 2 with something that this reader does not know; babeltrace2 from version 2.1 on "
           "converts it";
  }
  if (first == std::ifstream::traits_type::eof()) {
    return "its metadata are empty: a full disk or a killed session daemon leaves such a trace";
  }
  return "its metadata are damaged or not those of CTF 1.8; a full disk or a killed session daemon cuts them";
}

// Why our own decoder does not know the metadata; empty if it does. libbabeltrace2 says it in other words in each
// version.
std::string complaint_about_metadata(const fs::path& trace) {
  try {
    ctf::parse_metadata(ctf::read_metadata(trace / "metadata"));
  } catch (const ctf::UnsupportedTrace& unsupported) {
    return unsupported.what();
  }
  return {};
}

void add_source(babeltrace::MessageGraph& graph, const TraceDirectories& directories) {
  const babeltrace::Value parameters(bt_value_map_create());
  bt_value* inputs = nullptr;
  babeltrace::check(bt_value_map_insert_empty_array_entry(parameters.get(), "inputs", &inputs), "bt_value_map_insert");
  for (const fs::path& directory : directories) {
    babeltrace::check(bt_value_array_append_string_element(inputs, directory.c_str()), "bt_value_array_append");
  }
  const fs::path& trace = directories.front();
  const std::string what = fmt::format("cannot read the trace '{}'", trace.string());
  try {
    graph.add_source(trace, parameters.get(), what, remedy_of(trace));
  } catch (const TraceReadError& error) {
    if (const std::string complaint = complaint_about_metadata(trace); !complaint.empty()) {
      throw TraceReadError(fmt::format("{}: {}", what, complaint), error.remedy(), error.details());
    }
    throw;
  }
}

}  // namespace

struct BabeltraceReader::Implementation {
  bool fetch_messages();

  fs::path directory;
  std::vector<TraceDirectories> traces;
  bool is_connected = false;
  babeltrace::MessageGraph graph{"fs"};
  MessageTranslator translator;  // its references must be released before the graph
  std::size_t next_message = 0;
  bool is_at_end = false;
  std::optional<TraceReadError> damage;
  std::vector<std::string> damage_lines;
};

BabeltraceReader::BabeltraceReader(const fs::path& directory, const std::vector<fs::path>& traces)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->directory = directory;
  implementation_->traces = group_by_identity(traces);
}

BabeltraceReader::~BabeltraceReader() = default;

// Replaces the messages by the next ones. Returns false when there are none left. Throws TraceReadError.
bool BabeltraceReader::Implementation::fetch_messages() {
  if (!is_connected) {
    for (const TraceDirectories& each : traces) {
      add_source(graph, each);
    }
    is_connected = true;
  }
  next_message = 0;
  const std::string what = fmt::format("the trace '{}' is damaged or ends early", directory.string());
  return graph.fetch(what, kDamagedRemedy) != babeltrace::MessageGraph::Fetch::kEnd;
}

TraceItem BabeltraceReader::next() {
  Implementation& reader = *implementation_;
  try {
    while (!reader.is_at_end) {
      while (reader.next_message < reader.graph.messages().size()) {
        if (const TraceItem item = reader.translator.translate(reader.graph.messages()[reader.next_message++].get())) {
          return item;
        }
      }
      reader.is_at_end = !reader.fetch_messages();
    }
  } catch (const TraceReadError& error) {
    reader.is_at_end = true;
    if (!reader.damage) {
      reader.damage = error;
    }
    reader.damage_lines.emplace_back(error.what());
  }
  return {};
}

void BabeltraceReader::note(const std::string& damage) {
  Implementation& reader = *implementation_;
  if (!reader.damage) {
    reader.damage = TraceReadError(
        fmt::format("the trace '{}' is damaged or ends early: {}", reader.directory.string(), damage), kBesideRemedy);
  }
  reader.damage_lines.push_back(damage);
}

void BabeltraceReader::throw_damage() const {
  if (implementation_->damage) {
    throw TraceReadError(*implementation_->damage);
  }
}

const std::vector<std::string>& BabeltraceReader::damage() const {
  return implementation_->damage_lines;
}

const std::deque<TraceDescription>& BabeltraceReader::traces() const {
  return implementation_->translator.traces();
}

}  // namespace tracing
