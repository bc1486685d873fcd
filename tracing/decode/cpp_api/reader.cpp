// SPDX-License-Identifier: Apache-2.0
#include "launch_trace/reader.hpp"

#include <deque>
#include <unordered_map>

#include "tracing/decode/cpp_api/access.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace launch_trace {

struct Reader::Implementation {
  Implementation(const std::vector<std::filesystem::path>& directories, Options with)
      : options(with), reader(directories) {}

  const Item* next();
  const KnownClass& known_class(const tracing::Event& event);
  const Stream& known_stream(const tracing::Stream& stream);
  const Trace& known_trace(std::size_t index);

  Options options;
  tracing::TraceReader reader;
  std::deque<Trace> traces;
  std::vector<std::unique_ptr<KnownClass>> classes;  // by tracing::EventClass::id
  std::unordered_map<const tracing::Stream*, Stream> streams;
  bool has_told_damage = false;
  Event event;
  Loss loss;
  Item item;
};

namespace {

Error as_error(const tracing::TraceReadError& error) {
  return {error.what(), error.remedy()};
}

}  // namespace

const Item* Reader::Implementation::next() {
  const tracing::TraceItem read = reader.next();
  if (read.event != nullptr) [[likely]] {
    const std::size_t id = read.event->event_class->id;
    const bool is_known = id < classes.size() && classes[id];
    Access::set(event, is_known ? *classes[id] : known_class(*read.event), *read.event);
    Access::set(item, &event, nullptr);
    return &item;
  }
  if (read.loss != nullptr) {
    loss.kind = read.loss->kind == tracing::Loss::Kind::kEvents ? Loss::Kind::kEvents : Loss::Kind::kPackets;
    loss.stream = &known_stream(*read.loss->stream);
    loss.begin_ns = read.loss->begin_ns;
    loss.end_ns = read.loss->end_ns;
    loss.count = read.loss->count;
    Access::set(item, nullptr, &loss);
    return &item;
  }
  if (options.damage_is_error && !has_told_damage) {
    has_told_damage = true;
    reader.throw_damage();
  }
  return nullptr;
}

const KnownClass& Reader::Implementation::known_class(const tracing::Event& first) {
  const tracing::EventClass& recorded = *first.event_class;
  if (recorded.id >= classes.size()) {
    classes.resize(recorded.id + 1);
  }
  auto known = std::make_unique<KnownClass>();
  known->name = recorded.name;
  known->index = recorded.id;
  known->trace = &known_trace(recorded.trace);
  known->fields = recorded.fields;
  known->contexts = recorded.contexts;
  set_view(*known, first);
  classes[recorded.id] = std::move(known);
  return *classes[recorded.id];
}

const Stream& Reader::Implementation::known_stream(const tracing::Stream& recorded) {
  const auto [known, is_new] = streams.try_emplace(&recorded);
  if (is_new) {
    known->second = {recorded.name, &known_trace(recorded.trace), recorded.vpid};
  }
  return known->second;
}

const Trace& Reader::Implementation::known_trace(std::size_t index) {
  while (traces.size() <= index) {
    const tracing::TraceDescription& recorded = reader.traces()[traces.size()];
    Trace& trace = traces.emplace_back();
    trace.index = traces.size() - 1;
    trace.directories = recorded.directories;
    trace.uuid = recorded.uuid;
    trace.environment = recorded.environment;
    trace.hostname = recorded.text("hostname");
    trace.domain = recorded.text("domain");
  }
  return traces[index];
}

Reader::Reader(const std::filesystem::path& directory, Options options) : Reader(std::vector{directory}, options) {}

Reader::Reader(const std::vector<std::filesystem::path>& directories, Options options) {
  try {
    implementation_ = std::make_unique<Implementation>(directories, options);
  } catch (const tracing::TraceReadError& error) {
    throw as_error(error);
  }
}

Reader::~Reader() = default;
Reader::Reader(Reader&&) noexcept = default;
Reader& Reader::operator=(Reader&&) noexcept = default;

const Item* Reader::next() {
  try {
    return implementation_->next();
  } catch (const tracing::TraceReadError& error) {
    throw as_error(error);
  }
}

const std::vector<std::string>& Reader::damage() const {
  return implementation_->reader.damage();
}

const std::vector<std::filesystem::path>& Reader::open_directories() const {
  return implementation_->reader.open_directories();
}

bool Reader::lacks_descriptions() const {
  return implementation_->reader.lacks_descriptions();
}

}  // namespace launch_trace
