// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/python_api/trace_columns.hpp"

#include <fmt/format.h>

#include <deque>
#include <memory>
#include <string_view>

#include "tracing/decode/python_api/column.hpp"

namespace tracing::python {

namespace py = pybind11;

namespace {

constexpr const char* kUsual[] = {"time_ns", "cpu_id", "vpid", "vtid", "procname", "host"};
constexpr std::size_t kCheckSignals = 1 << 20;  // events

// Where a column finds its value in the events of one class.
struct Source {
  enum class Kind { kTime, kCpu, kProcess, kThread, kName, kHost, kField, kContext };
  Kind kind = Kind::kField;
  std::size_t index = 0;
};

Source find_source(const EventClass& event_class, const std::string& name) {
  if (const auto index = event_class.index_of(name)) {
    return {Source::Kind::kField, *index};
  }
  if (name == "time_ns") {
    return {Source::Kind::kTime};
  }
  if (name == "cpu_id") {
    return {Source::Kind::kCpu};
  }
  if (name == "vpid") {
    return {Source::Kind::kProcess};
  }
  if (name == "vtid") {
    return {Source::Kind::kThread};
  }
  if (name == "procname") {
    return {Source::Kind::kName};
  }
  if (name == "host") {
    return {Source::Kind::kHost};
  }
  if (const auto index = event_class.index_of_context(name)) {
    return {Source::Kind::kContext, *index};
  }
  std::string known;
  for (const std::string& field : event_class.fields) {
    known += ", " + field;
  }
  for (const char* usual : kUsual) {
    known += fmt::format(", {}", usual);
  }
  throw py::key_error(fmt::format("{} has no field '{}'; it has {}", event_class.name, name, known.substr(2)));
}

class ColumnReader {
 public:
  ColumnReader(const TraceReader& reader, const std::optional<std::vector<std::string>>& names)
      : reader_(reader), has_names_(names.has_value()) {
    if (names) {
      names_ = *names;
    }
    columns_.resize(names_.size());
  }

  void add(const Event& event) {
    const std::vector<Source>& sources = sources_of(*event.event_class);
    for (std::size_t i = 0; i < sources.size(); ++i) {
      add(columns_[i], sources[i], event);
    }
  }

  py::dict take() {
    if (!has_names_) {
      add_usual_names({});
    }
    py::dict result;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      result[py::str(names_[i])] = columns_[i].take();
    }
    return result;
  }

 private:
  void add(Column& column, const Source& source, const Event& event) const {
    switch (source.kind) {
      case Source::Kind::kTime:
        return column.add(std::optional(event.timestamp_ns));
      case Source::Kind::kCpu:
        return column.add(event.cpu_id);
      case Source::Kind::kProcess:
        return column.add(event.vpid);
      case Source::Kind::kThread:
        return column.add(event.vtid);
      case Source::Kind::kName:
        return column.add(event.procname);
      case Source::Kind::kHost:
        return column.add(host_of(event));
      case Source::Kind::kField:
        return column.add(event.field(source.index));
      case Source::Kind::kContext:
        return column.add(event.context(source.index));
    }
  }

  std::optional<std::string_view> host_of(const Event& event) const {
    const auto& environment = reader_.traces()[event.event_class->trace].environment;
    const auto host = environment.find("hostname");
    const auto* const name = host == environment.end() ? nullptr : std::get_if<std::string>(&host->second);
    return name == nullptr ? "" : std::string_view(*name);
  }

  const std::vector<Source>& sources_of(const EventClass& event_class) {
    if (event_class.id >= sources_.size()) {
      sources_.resize(event_class.id + 1);
    }
    std::unique_ptr<std::vector<Source>>& slot = sources_[event_class.id];
    if (slot) {
      return *slot;
    }
    if (!has_names_) {
      add_usual_names(event_class.fields);
    }
    slot = std::make_unique<std::vector<Source>>();
    for (const std::string& name : names_) {
      slot->push_back(find_source(event_class, name));
    }
    return *slot;
  }

  void add_usual_names(const std::vector<std::string>& fields) {
    has_names_ = true;
    names_.assign(std::begin(kUsual), std::end(kUsual));
    names_.insert(names_.end(), fields.begin(), fields.end());
    columns_.resize(names_.size());
  }

  const TraceReader& reader_;
  bool has_names_;
  std::vector<std::string> names_;
  std::deque<Column> columns_;                                 // one for each name
  std::vector<std::unique_ptr<std::vector<Source>>> sources_;  // by EventClass::id
};

}  // namespace

py::dict read_columns(TraceReader& reader, const std::string& event,
                      const std::optional<std::vector<std::string>>& names) {
  ColumnReader columns(reader, names);
  std::vector<signed char> is_wanted;  // by EventClass::id: 1 wanted, 0 not, -1 not known yet
  std::size_t items = 0;
  while (const TraceItem item = reader.next()) {
    if (++items % kCheckSignals == 0 && PyErr_CheckSignals() != 0) {
      throw py::error_already_set();
    }
    if (item.event == nullptr) {
      continue;
    }
    const std::size_t id = item.event->event_class->id;
    if (id >= is_wanted.size()) {
      is_wanted.resize(id + 1, -1);
    }
    if (is_wanted[id] < 0) {
      is_wanted[id] = item.event->name() == event ? 1 : 0;
    }
    if (is_wanted[id] == 1) {
      columns.add(*item.event);
    }
  }
  return columns.take();
}

}  // namespace tracing::python
