// SPDX-License-Identifier: Apache-2.0
// launch_trace.Event: an event as an object of Python, which keeps its values when the reading goes on. Also the values
// of its fields as objects.
//
// The type is made with Python's own functions: an object of a pybind11 class takes several times as long to make and
// to ask.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tracing/decode/reader/event.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing::python {

// Bytes that are not UTF-8 become U+FFFD.
pybind11::object text_object(std::string_view text);

// An integer, a float or a text; an enumeration's value with a label is this label; an array is a tuple, a structure a
// dict, a variant its selected option.
pybind11::object field_object(const FieldValue& value);

// Makes the type, to be added to the module.
pybind11::object make_event_type();

// Makes the objects of one reading.
class EventMaker {
 public:
  EventMaker(pybind11::object type, const TraceReader& reader);
  ~EventMaker();

  pybind11::object make(const Event& event);

 private:
  // What the objects of one event class share.
  struct KnownClass {
    pybind11::object name;
    pybind11::object host;
    pybind11::dict fields;                    // name → index
    pybind11::tuple context_names;            // of the contexts that have no attribute of their own
    std::vector<std::size_t> other_contexts;  // their indices
  };
  // Consecutive events often have equal values.
  struct LastNumber {
    std::optional<std::int64_t> value;
    pybind11::object object = pybind11::none();
  };
  KnownClass facts_of(const EventClass& event_class) const;
  static PyObject* number_object(const std::optional<std::int64_t>& number, LastNumber& last);
  PyObject* procname_object(const std::optional<std::string_view>& procname);

  pybind11::object type_;
  const TraceReader& reader_;
  ByEventClass<KnownClass> classes_;
  std::unordered_map<std::string, pybind11::object> procnames_;
  std::string last_procname_;
  pybind11::object last_procname_object_;
  LastNumber last_vpid_;
  LastNumber last_vtid_;
};

}  // namespace tracing::python
