// SPDX-License-Identifier: Apache-2.0
#include "tracing/expect/python/python_expectations.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <map>
#include <optional>
#include <variant>

#include "launch_trace_testing/expectations.hpp"

namespace launch_trace_testing {

namespace py = pybind11;

namespace {

void assert_that(const Verdict& verdict) {
  if (verdict) {
    return;
  }
  PyErr_SetString(PyExc_AssertionError, verdict.text.c_str());
  throw py::error_already_set();
}

// The expectation as a method that raises.
template <class... Arguments>
auto asserted(Verdict (*expect)(const Trace&, Arguments...)) {
  return [expect](const Trace& trace, Arguments... arguments) { assert_that(expect(trace, arguments...)); };
}

// A number, or one of the words at_least() and so on.
Count count_of(const py::object& given) {
  if (py::isinstance<Count>(given)) {
    return given.cast<Count>();
  }
  if (py::isinstance<py::int_>(given)) {
    return exactly(given.cast<std::size_t>());
  }
  return given.attr("count")().cast<Count>();
}

Bounds bounds_of(const py::object& given) {
  if (given.is_none()) {
    return {};
  }
  if (py::isinstance<Bounds>(given)) {
    return given.cast<Bounds>();
  }
  return given.attr("bounds")().cast<Bounds>();
}

// An expectation of the times of callbacks.
auto asserted_of_callbacks(Verdict (*expect)(const Trace&, const CallbackChoice&, Bounds)) {
  return [expect](const Trace& trace, const py::object& time, const std::string& node, const std::string& topic,
                  const std::string& service, const std::string& symbol, bool timers_only) {
    assert_that(expect(trace, {node, topic, service, symbol, timers_only}, bounds_of(time)));
  };
}

std::chrono::nanoseconds nanoseconds(double seconds) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9));
}

FieldKind kind_of(const std::string& name) {
  static const std::map<std::string, FieldKind> kinds{{"handle", FieldKind::kHandle},
                                                      {"pointer", FieldKind::kPointer},
                                                      {"pointer or null", FieldKind::kPointerOrNull},
                                                      {"text", FieldKind::kText},
                                                      {"non-empty text", FieldKind::kNonEmptyText},
                                                      {"integer", FieldKind::kInteger},
                                                      {"queue depth", FieldKind::kQueueDepth},
                                                      {"real", FieldKind::kReal},
                                                      {"array", FieldKind::kArray}};
  const auto found = kinds.find(name);
  if (found != kinds.end()) {
    return found->second;
  }
  std::string names;
  for (const auto& [known, kind] : kinds) {
    names += (names.empty() ? "'" : ", '") + known + "'";
  }
  throw py::value_error("'" + name + "' is no kind of field; there are " + names);
}

void add_limits(py::module_& module) {
  py::class_<Count>(module, "Count")
      .def(py::init([](std::size_t least, std::optional<std::size_t> most) {
             return Count{least, most.value_or(Count{}.most)};
           }),
           py::arg("least") = 0, py::arg("most") = py::none());
  py::class_<Bounds>(module, "Bounds")
      .def(py::init([](double least, std::optional<double> most, double share) {
             return Bounds{nanoseconds(least), most ? nanoseconds(*most) : Bounds{}.most, share};
           }),
           py::arg("least") = 0, py::arg("most") = py::none(), py::arg("share") = 1);
}

}  // namespace

void add_expectations(py::module_& module) {
  using Directories = std::variant<std::filesystem::path, std::vector<std::filesystem::path>>;
  add_limits(module);
  constexpr auto kInside = py::return_value_policy::reference_internal;
  py::class_<Trace>(module, "Trace", "A whole trace in memory: a sequence of events. expect…() raise AssertionError.")
      .def(py::init([](const Directories& given) {
             const auto* const one = std::get_if<std::filesystem::path>(&given);
             return one != nullptr ? Trace(*one) : Trace(std::get<std::vector<std::filesystem::path>>(given));
           }),
           py::arg("directories"))
      .def("__len__", &Trace::size)
      .def(
          "__iter__", [](const Trace& trace) { return py::make_iterator<kInside>(trace.begin(), trace.end()); },
          py::keep_alive<0, 1>())
      .def(
          "__getitem__",
          [](const Trace& trace, std::size_t index) -> const Event& {
            if (index >= trace.size()) {
              throw py::index_error();
            }
            return trace.events()[index];
          },
          kInside)
      .def("__repr__", [](const Trace& trace) { return "<" + to_string(trace) + ">"; })
      .def_property_readonly("losses", &Trace::losses)
      .def_property_readonly("damage", &Trace::damage)
      .def_property_readonly("directories", &Trace::directories)
      .def_property_readonly("callbacks", &Trace::callbacks, kInside)
      .def_property_readonly("deliveries", &Trace::deliveries, kInside)
      .def_property_readonly("begin_ns", &Trace::begin_ns)
      .def_property_readonly("end_ns", &Trace::end_ns)
      .def(
          "select", [](const Trace& trace, const EventQuery& query) { return query.select(trace); }, kInside,
          py::arg("query"), "The events that are meant, in their order.")
      .def(
          "first", [](const Trace& trace, const EventQuery& query) { return query.first(trace); }, kInside,
          py::arg("query"), "The first of them, or None.")
      .def(
          "expect",
          [](const Trace& trace, const EventQuery& query, const py::object& count) {
            assert_that(expect_count(trace, query, count.is_none() ? at_least(1) : count_of(count)));
            return query.select(trace);
          },
          kInside, py::arg("query"), py::arg("count") = py::none(),
          "There are so many of these events: a number, at_least(1), at_most(5), …; without it at least one.\n"
          "Returns them.")
      .def(
          "expect_none",
          [](const Trace& trace, const EventQuery& query) { assert_that(expect_count(trace, query, exactly(0))); },
          py::arg("query"))
      .def("expect_each", asserted(expect_each), py::arg("all"), py::arg("required"),
           "Each of the events meets the conditions of the other query.")
      .def(
          "expect_field",
          [](const Trace& trace, const EventQuery& query, const std::string& field, const std::string& kind,
             std::optional<std::size_t> length) {
            assert_that(expect_field(trace, query, field, kind_of(kind), length));
          },
          py::arg("query"), py::arg("field"), py::arg("kind"), py::arg("length") = py::none(),
          "The field of each event is of the kind: 'handle', 'pointer', 'pointer or null', 'text', 'non-empty text',\n"
          "'integer', 'queue depth', 'real', 'array'.")
      .def("expect_names", asserted(expect_event_names), py::arg("names"), py::arg("among") = "*",
           "The events have exactly these names.")
      .def("expect_processes", asserted(expect_processes), py::arg("names"))
      .def("expect_order", asserted(expect_order), py::arg("queries"),
           "An event of each query, each behind the one before.")
      .def("expect_sorted", asserted(expect_sorted), py::arg("events"))
      .def("expect_happens_before", asserted(expect_happens_before), py::arg("cause"), py::arg("effect"))
      .def("expect_matching_field", asserted(expect_matching_field), py::arg("event"), py::arg("field"),
           py::arg("other"), py::arg("other_field") = "")
      .def(
          "expect_delivered",
          [](const Trace& trace, const std::string& topic, const py::object& count, const py::object& latency,
             const std::string& publisher, const std::string& subscriber) {
            assert_that(expect_delivered(trace, {topic, publisher, subscriber},
                                         count.is_none() ? at_least(1) : count_of(count), bounds_of(latency)));
          },
          py::arg("topic"), py::arg("count") = py::none(), py::arg("latency") = py::none(), py::kw_only(),
          py::arg("publisher") = "", py::arg("subscriber") = "", "Messages have gone from publish() to a callback.")
      .def(
          "expect_all_delivered",
          [](const Trace& trace, const std::string& topic, std::size_t most_missing, double settling,
             const std::string& publisher, const std::string& subscriber) {
            assert_that(
                expect_all_delivered(trace, {topic, publisher, subscriber}, most_missing, nanoseconds(settling)));
          },
          py::arg("topic"), py::arg("most_missing") = 0, py::arg("settling") = 0.1, py::kw_only(),
          py::arg("publisher") = "", py::arg("subscriber") = "")
      .def("expect_callback_duration", asserted_of_callbacks(expect_callback_duration), py::arg("duration"),
           py::kw_only(), py::arg("node") = "", py::arg("topic") = "", py::arg("service") = "", py::arg("symbol") = "",
           py::arg("timers_only") = false)
      .def("expect_callback_period", asserted_of_callbacks(expect_callback_period), py::arg("period"), py::kw_only(),
           py::arg("node") = "", py::arg("topic") = "", py::arg("service") = "", py::arg("symbol") = "",
           py::arg("timers_only") = false)
      .def(
          "expect_period",
          [](const Trace& trace, const EventQuery& query, const py::object& period) {
            assert_that(expect_period(trace, query, bounds_of(period)));
          },
          py::arg("query"), py::arg("period"))
      .def(
          "expect_duration",
          [](const Trace& trace, const EventQuery& begin, const EventQuery& end, const py::object& duration) {
            assert_that(expect_duration(trace, begin, end, bounds_of(duration)));
          },
          py::arg("begin"), py::arg("end"), py::arg("duration"))
      .def("expect_no_loss", asserted(expect_no_loss));
}

}  // namespace launch_trace_testing
