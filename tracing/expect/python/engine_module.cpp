// SPDX-License-Identifier: Apache-2.0
// The module `launch_trace_testing._engine`: traces, queries and runs for Python.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "launch_trace_testing/event.hpp"
#include "launch_trace_testing/event_query.hpp"
#include "launch_trace_testing/launch_run.hpp"
#include "tracing/expect/python/python_expectations.hpp"

namespace launch_trace_testing {

namespace py = pybind11;

namespace {

py::object python_value(const Value& value) {
  struct Object {
    py::object operator()(std::uint64_t number) const { return py::int_(number); }
    py::object operator()(std::int64_t number) const { return py::int_(number); }
    py::object operator()(double number) const { return py::float_(number); }
    py::object operator()(const std::string& text) const {
      PyObject* const object = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
      if (object == nullptr) {
        throw py::error_already_set();
      }
      return py::reinterpret_steal<py::object>(object);
    }
    py::object operator()(const Value::Enumeration& enumeration) const {
      return enumeration.label.empty() ? py::object(py::int_(enumeration.number))
                                       : py::object(py::str(enumeration.label));
    }
    py::object operator()(const Value::Array& elements) const {
      py::tuple tuple(elements.size());
      for (std::size_t i = 0; i < elements.size(); ++i) {
        tuple[i] = python_value(elements[i]);
      }
      return tuple;
    }
    py::object operator()(const Value::Structure& members) const {
      py::dict dict;
      for (const Value::Member& member : members) {
        dict[py::str(member.name)] = python_value(member.value);
      }
      return dict;
    }
  };
  return std::visit(Object{}, value.data);
}

// Throws a TypeError for an object that no field can be equal to.
Value value_of(const py::handle& object) {
  if (py::isinstance<py::bool_>(object)) {
    return {std::int64_t{object.cast<bool>()}};
  }
  if (py::isinstance<py::int_>(object)) {
    if (object.cast<py::int_>() < py::int_(0)) {
      return {object.cast<std::int64_t>()};
    }
    return {object.cast<std::uint64_t>()};
  }
  if (py::isinstance<py::float_>(object)) {
    return {object.cast<double>()};
  }
  if (py::isinstance<py::str>(object)) {
    return {object.cast<std::string>()};
  }
  if (py::isinstance<py::tuple>(object) || py::isinstance<py::list>(object)) {
    Value::Array elements;
    for (const py::handle element : object) {
      elements.push_back(value_of(element));
    }
    return {std::move(elements)};
  }
  throw py::type_error("a field is an int, a float, a str, or a list or tuple of these, not " +
                       py::str(py::type::of(object).attr("__name__")).cast<std::string>());
}

// A run that can be ended before Python forgets it.
struct Run {
  std::unique_ptr<LaunchRun> launch;  // null: it was closed

  // Throws std::runtime_error when it was closed.
  LaunchRun& open() const {
    if (!launch) {
      throw std::runtime_error("the run is closed");
    }
    return *launch;
  }
};

void add_events(py::module_& module) {
  py::class_<Loss>(module, "Loss", "Events that the tracer could not keep.")
      .def_readonly("whole_packets", &Loss::whole_packets)
      .def_readonly("count", &Loss::count, "How many; None: some")
      .def_readonly("begin_ns", &Loss::begin_ns)
      .def_readonly("end_ns", &Loss::end_ns)
      .def_readonly("stream", &Loss::stream);
  py::class_<CallbackRun>(module, "CallbackRun", "One run of a callback.")
      .def_readonly("node", &CallbackRun::node)
      .def_readonly("topic", &CallbackRun::topic)
      .def_readonly("service", &CallbackRun::service)
      .def_readonly("is_timer", &CallbackRun::is_timer)
      .def_readonly("period_ns", &CallbackRun::period_ns)
      .def_readonly("symbol", &CallbackRun::symbol)
      .def_readonly("vpid", &CallbackRun::vpid)
      .def_readonly("vtid", &CallbackRun::vtid)
      .def_readonly("start_ns", &CallbackRun::start_ns)
      .def_readonly("end_ns", &CallbackRun::end_ns)
      .def_readonly("finished", &CallbackRun::finished);
  py::class_<Delivery>(module, "Delivery", "The way of one message to one subscription. A time is 0 where it ended.")
      .def_readonly("topic", &Delivery::topic)
      .def_readonly("publisher", &Delivery::publisher)
      .def_readonly("subscriber", &Delivery::subscriber)
      .def_readonly("publisher_vpid", &Delivery::publisher_vpid)
      .def_readonly("subscriber_vpid", &Delivery::subscriber_vpid)
      .def_readonly("called_ns", &Delivery::called_ns)
      .def_readonly("published_ns", &Delivery::published_ns)
      .def_readonly("taken_ns", &Delivery::taken_ns)
      .def_readonly("callback_start_ns", &Delivery::callback_start_ns)
      .def_readonly("callback_end_ns", &Delivery::callback_end_ns);
  py::class_<Event>(module, "Event", "An event. event['field'] is the value of a field or a context.")
      .def_property_readonly("name", &Event::name)
      .def_property_readonly("host", &Event::host)
      .def_property_readonly("time_ns", &Event::time_ns)
      .def_property_readonly("position", &Event::position)
      .def_property_readonly("cpu_id", &Event::cpu_id)
      .def_property_readonly("vpid", &Event::vpid)
      .def_property_readonly("vtid", &Event::vtid)
      .def_property_readonly("procname", &Event::procname)
      .def("keys", [](const Event& event) { return event.event_class().fields; })
      .def(
          "get",
          [](const Event& event, const std::string& field, const py::object& other) {
            const Value* const value = event.find(field);
            return value == nullptr ? other : python_value(*value);
          },
          py::arg("field"), py::arg("other") = py::none())
      .def("__contains__", [](const Event& event, const std::string& field) { return event.find(field) != nullptr; })
      .def("__getitem__",
           [](const Event& event, const std::string& field) {
             try {
               return python_value(event.at(field));
             } catch (const std::out_of_range& error) {
               throw py::key_error(error.what());
             }
           })
      .def("__repr__", [](const Event& event) { return "<" + to_string(event) + ">"; });
}

void add_queries(py::module_& module) {
  constexpr auto kSelf = py::return_value_policy::reference_internal;
  py::class_<EventQuery>(module, "EventQuery", "Says which events are meant. Its methods return it.")
      .def(py::init<std::string>(), py::arg("name"))
      .def(
          "with_field",
          [](EventQuery& query, const std::string& field, const py::handle& value) -> EventQuery& {
            return query.with(field, value_of(value));
          },
          kSelf, py::arg("field"), py::arg("value"), "The field is equal to the value.")
      .def(
          "where", [](EventQuery& query, const std::string& text) -> EventQuery& { return query.where(text); }, kSelf,
          py::arg("expression"), "A condition on fields: 'data > 3 && topic_name =~ \"^/p\"'.")
      .def(
          "in_process",
          [](EventQuery& query, const py::object& process) -> EventQuery& {
            return query.in_process(std::string_view(py::str(process).cast<std::string>()));
          },
          kSelf, py::arg("process"), "A name, a pattern of names, or an id.")
      .def(
          "after", [](EventQuery& query, const Event& event) -> EventQuery& { return query.after(event); }, kSelf)
      .def(
          "before", [](EventQuery& query, const Event& event) -> EventQuery& { return query.before(event); }, kSelf)
      .def(
          "in_thread_of",
          [](EventQuery& query, const Event& event) -> EventQuery& { return query.in_thread_of(event); }, kSelf)
      .def(
          "from_time", [](EventQuery& query, std::int64_t ns) -> EventQuery& { return query.from_time(ns); }, kSelf)
      .def(
          "until_time", [](EventQuery& query, std::int64_t ns) -> EventQuery& { return query.until_time(ns); }, kSelf)
      .def(
          "that",
          [](EventQuery& query, std::string description, const py::function& holds) -> EventQuery& {
            return query.that(std::move(description), [holds](const Event& event) {
              return py::cast<bool>(py::bool_(holds(py::cast(event, py::return_value_policy::reference))));
            });
          },
          kSelf, py::arg("description"), py::arg("holds"), "Any other condition, a function of an event.")
      .def("matches", &EventQuery::matches)
      .def("__repr__", [](const EventQuery& query) { return "<events " + query.describe() + ">"; });
}

void add_runs(py::module_& module) {
  py::class_<RunResult>(module, "RunResult")
      .def_readonly("exit_code", &RunResult::exit_code)
      .def_readonly("signal", &RunResult::signal)
      .def_readonly("timed_out", &RunResult::timed_out)
      .def_readonly("left", &RunResult::left)
      .def_readonly("out", &RunResult::out)
      .def_readonly("err", &RunResult::err);
  py::class_<Run>(module, "LaunchRun", "A system that runs, with a session, a ROS domain and a directory of its own.")
      .def(py::init([](const std::optional<std::filesystem::path>& file,
                       const std::map<std::string, std::string>& arguments, const std::vector<Program>& programs,
                       const std::vector<std::string>& events, bool all_processes,
                       const std::map<std::string, std::string>& environment, double patience) {
             RunOptions options;
             if (file) {
               options.file = *file;
             }
             options.arguments.assign(arguments.begin(), arguments.end());
             options.programs = programs;
             options.events = events;
             options.all_processes = all_processes;
             options.environment = environment;
             options.patience = std::chrono::milliseconds(static_cast<std::int64_t>(patience * 1000));
             return Run{std::make_unique<LaunchRun>(std::move(options))};
           }),
           py::arg("file") = py::none(), py::kw_only(), py::arg("arguments") = std::map<std::string, std::string>(),
           py::arg("programs") = std::vector<Program>(), py::arg("events") = RunOptions().events,
           py::arg("all_processes") = false, py::arg("environment") = std::map<std::string, std::string>(),
           py::arg("patience") = 60.0,
           "Starts a launch file, programs (lists of words), or both. `events` is what is recorded; without one, the\n"
           "launch file's own trace is read. `patience` is how many seconds each wait lasts.")
      .def(
          "wait", [](const Run& run) { return run.open().wait(); }, py::call_guard<py::gil_scoped_release>(),
          "Until the system has ended by itself.")
      .def(
          "stop", [](const Run& run) { return run.open().stop(); }, py::call_guard<py::gil_scoped_release>(),
          "Ends the system as Ctrl-C does.")
      .def(
          "wait_for_output", [](const Run& run, const std::string& text) { return run.open().wait_for_output(text); },
          py::call_guard<py::gil_scoped_release>(), py::arg("text"),
          "Whether the launcher or a process writes the text before the end of the run.")
      .def(
          "trace", [](const Run& run) { return run.open().trace(); }, py::call_guard<py::gil_scoped_release>(),
          "After wait() or stop().")
      .def(
          "keep", [](const Run& run) { run.open().keep(); }, "The directory stays.")
      .def(
          "close", [](Run& run) { run.launch.reset(); }, py::call_guard<py::gil_scoped_release>(),
          "Ends the system if it runs, and removes its directory.")
      .def_property_readonly("directory", [](const Run& run) { return run.open().directory(); })
      .def_property_readonly("domain_id", [](const Run& run) { return run.open().domain_id(); })
      .def_property_readonly("out", [](const Run& run) { return run.open().out(); })
      .def_property_readonly("err", [](const Run& run) { return run.open().err(); });
}

}  // namespace

PYBIND11_MODULE(_engine, module) {
  py::register_exception<TraceError>(module, "TraceError", PyExc_RuntimeError);
  py::register_exception<QueryError>(module, "QueryError", PyExc_ValueError);
  add_events(module);
  add_queries(module);
  add_expectations(module);
  add_runs(module);
}

}  // namespace launch_trace_testing
