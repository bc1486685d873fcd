// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/python_api/trace_columns.hpp"

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>

#include "tracing/decode/python_api/event_object.hpp"

namespace tracing::python {

namespace py = pybind11;

namespace {

// Owns the numbers of a memoryview.
template <class Number>
struct Numbers {
  std::vector<Number> values;
};

template <class Number>
void add_numbers_type(py::module_& module, const char* name) {
  py::class_<Numbers<Number>>(module, name, py::buffer_protocol()).def_buffer([](Numbers<Number>& numbers) {
    return py::buffer_info(numbers.values.data(), static_cast<py::ssize_t>(numbers.values.size()), true);
  });
}

bool has_numpy() {
  static const bool has = [] {
    try {
      py::module_::import("numpy");
      return true;
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_ImportError)) {
        throw;
      }
      return false;
    }
  }();
  return has;
}

// The array takes the numbers without a copy.
template <class Number>
py::object array_of(std::vector<Number> numbers) {
  if (!has_numpy()) {
    return py::memoryview(py::cast(Numbers<Number>{std::move(numbers)}));
  }
  auto owned = std::make_unique<std::vector<Number>>(std::move(numbers));
  const py::capsule owner(owned.get(), [](void* pointer) { delete static_cast<std::vector<Number>*>(pointer); });
  const std::vector<Number>& values = *owned.release();
  return py::array_t<Number>(static_cast<py::ssize_t>(values.size()), values.data(), owner);
}

py::object array_of(std::vector<py::object> objects) {
  py::list list(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    list[i] = std::move(objects[i]);
  }
  if (!has_numpy()) {
    return list;
  }
  // Filled one by one: NumPy would make a second dimension of tuples.
  py::object array = py::module_::import("numpy").attr("empty")(list.size(), py::arg("dtype") = "object");
  for (std::size_t i = 0; i < list.size(); ++i) {
    array[py::int_(i)] = list[i];
  }
  return array;
}

// The values of one field of many events, as one array. The first value decides the kind of the column: integers
// without or with sign, real numbers, or objects of Python. A later value of another kind turns it into a column of
// objects.
class Column {
 public:
  void add(const FieldValue& value);
  void add(std::optional<std::int64_t> number);  // -1: there is none
  void add(std::optional<std::string_view> text);

  // An array of NumPy where it is installed. Otherwise a memoryview of the numbers, or a list of the objects.
  py::object take();

 private:
  using Objects = std::vector<py::object>;

  template <class Number>
  void add_number(Number number);
  void add_object(py::object object);
  py::object shared_text(std::string_view text);

  std::variant<std::monostate, std::vector<std::uint64_t>, std::vector<std::int64_t>, std::vector<double>, Objects>
      values_;
  std::unordered_map<std::string, py::object> texts_;  // most columns of texts repeat a few
};

py::object Column::shared_text(std::string_view text) {
  constexpr std::size_t kMost = 10'000;
  if (texts_.size() > kMost) {
    return text_object(text);
  }
  const auto [known, is_new] = texts_.try_emplace(std::string(text));
  if (is_new) {
    known->second = text_object(text);
  }
  return known->second;
}

void Column::add_object(py::object object) {
  auto* objects = std::get_if<Objects>(&values_);
  if (objects == nullptr) {
    Objects so_far;
    std::visit(
        [&]<class Values>(const Values& values) {
          if constexpr (!std::is_same_v<Values, std::monostate> && !std::is_same_v<Values, Objects>) {
            for (const auto value : values) {
              so_far.push_back(py::cast(value));
            }
          }
        },
        values_);
    objects = &values_.emplace<Objects>(std::move(so_far));
  }
  objects->push_back(std::move(object));
}

template <class Number>
void Column::add_number(Number number) {
  if (std::holds_alternative<std::monostate>(values_)) {
    values_.emplace<std::vector<Number>>();
  }
  if (auto* const numbers = std::get_if<std::vector<Number>>(&values_)) {
    numbers->push_back(number);
  } else {
    add_object(py::cast(number));
  }
}

void Column::add(const FieldValue& value) {
  if (value.is_enumeration() && value.enumeration_label()) {
    add_object(field_object(value));
  } else if (const auto number = value.unsigned_integer()) {
    add_number(*number);
  } else if (const auto with_sign = value.integer()) {
    add_number(*with_sign);
  } else if (const auto real = value.real()) {
    add_number(*real);
  } else if (const auto text = value.string()) {
    add_object(shared_text(*text));
  } else {
    add_object(field_object(value));
  }
}

void Column::add(std::optional<std::int64_t> number) {
  add_number(number.value_or(-1));
}

void Column::add(std::optional<std::string_view> text) {
  add_object(text ? shared_text(*text) : py::object(py::none()));
}

py::object Column::take() {
  return std::visit(
      []<class Values>(Values& values) -> py::object {
        if constexpr (std::is_same_v<Values, std::monostate>) {
          return array_of(std::vector<std::int64_t>());  // no event has told the kind
        } else {
          return array_of(std::move(values));
        }
      },
      values_);
}

constexpr std::size_t kCheckSignals = 1 << 20;  // events

// Where a column finds its value in the events of one class.
struct Source {
  enum class Kind { kTime, kCpu, kProcess, kThread, kName, kHost, kField, kContext };
  Kind kind = Kind::kField;
  std::size_t index = 0;
};

struct Usual {
  std::string_view name;
  Source::Kind kind;
};
constexpr Usual kUsual[] = {{"time_ns", Source::Kind::kTime},  {"cpu_id", Source::Kind::kCpu},
                            {"vpid", Source::Kind::kProcess},  {"vtid", Source::Kind::kThread},
                            {"procname", Source::Kind::kName}, {"host", Source::Kind::kHost}};

Source find_source(const EventClass& event_class, const std::string& name) {
  if (const auto index = event_class.index_of(name)) {
    return {Source::Kind::kField, *index};
  }
  if (const auto usual =
          std::find_if(std::begin(kUsual), std::end(kUsual), [&](const auto& one) { return one.name == name; });
      usual != std::end(kUsual)) {
    return {usual->kind};
  }
  if (const auto index = event_class.index_of_context(name)) {
    return {Source::Kind::kContext, *index};
  }
  std::string known;
  for (const std::string& field : event_class.fields) {
    known += ", " + field;
  }
  for (const Usual& usual : kUsual) {
    known += fmt::format(", {}", usual.name);
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
    const std::vector<Source>& sources =
        sources_.of(*event.event_class, [&] { return sources_of(*event.event_class); });
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
        return column.add(std::optional(reader_.traces()[event.event_class->trace].text("hostname")));
      case Source::Kind::kField:
        return column.add(event.field(source.index));
      case Source::Kind::kContext:
        return column.add(event.context(source.index));
    }
  }

  std::vector<Source> sources_of(const EventClass& event_class) {
    if (!has_names_) {
      add_usual_names(event_class.fields);
    }
    std::vector<Source> sources;
    for (const std::string& name : names_) {
      sources.push_back(find_source(event_class, name));
    }
    return sources;
  }

  void add_usual_names(const std::vector<std::string>& fields) {
    has_names_ = true;
    for (const Usual& usual : kUsual) {
      names_.emplace_back(usual.name);
    }
    names_.insert(names_.end(), fields.begin(), fields.end());
    columns_.resize(names_.size());
  }

  const TraceReader& reader_;
  bool has_names_;
  std::vector<std::string> names_;
  std::deque<Column> columns_;  // one for each name
  ByEventClass<std::vector<Source>> sources_;
};

}  // namespace

void add_buffer_type(py::module_& module) {
  add_numbers_type<std::uint64_t>(module, "_UnsignedNumbers");
  add_numbers_type<std::int64_t>(module, "_SignedNumbers");
  add_numbers_type<double>(module, "_RealNumbers");
}

py::dict read_columns(TraceReader& reader, const std::string& event,
                      const std::optional<std::vector<std::string>>& names) {
  ColumnReader columns(reader, names);
  ByEventClass<bool> is_wanted;
  std::size_t items = 0;
  while (const TraceItem item = reader.next()) {
    if (++items % kCheckSignals == 0 && PyErr_CheckSignals() != 0) {
      throw py::error_already_set();
    }
    if (item.event != nullptr && is_wanted.of(*item.event->event_class, [&] { return item.event->name() == event; })) {
      columns.add(*item.event);
    }
  }
  return columns.take();
}

}  // namespace tracing::python
