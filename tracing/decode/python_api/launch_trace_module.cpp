// SPDX-License-Identifier: Apache-2.0
// The module `launch_trace._events` of Python: reads traces, event by event or into columns.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tracing/decode/python_api/event_object.hpp"
#include "tracing/decode/python_api/reading.hpp"
#include "tracing/decode/python_api/trace_columns.hpp"

namespace tracing::python {
namespace {

namespace py = pybind11;
using Directories = std::variant<std::filesystem::path, std::vector<std::filesystem::path>>;
using Names = std::optional<std::vector<std::string>>;

class Trace {
 public:
  Trace(ReadingOptions options, py::object iterator_type)
      : options_(std::move(options)), iterator_type_(std::move(iterator_type)) {
    const TraceReader check(options_.directories);  // says now what can't be opened
    findings_->open_directories = check.open_directories();
  }

  py::object iterate(std::vector<std::string> patterns) const {
    return make_iterator(iterator_type_, std::make_unique<Reading>(options_, findings_, std::move(patterns)));
  }
  py::dict columns(const std::string& event, const Names& names) const {
    return Reading(options_, findings_, {}).columns(event, names);
  }

  const Findings& findings() const { return *findings_; }
  const std::vector<std::filesystem::path>& directories() const { return options_.directories; }

 private:
  ReadingOptions options_;
  py::object iterator_type_;
  std::shared_ptr<Findings> findings_ = std::make_shared<Findings>();
};

std::vector<std::filesystem::path> all_of(const Directories& directories) {
  if (const auto* const one = std::get_if<std::filesystem::path>(&directories)) {
    return {*one};
  }
  return std::get<std::vector<std::filesystem::path>>(directories);
}

std::vector<std::string> patterns_of(const py::args& arguments) {
  std::vector<std::string> patterns;
  for (const py::handle pattern : arguments) {
    patterns.push_back(pattern.cast<std::string>());
  }
  if (patterns.empty()) {
    patterns.emplace_back("*");
  }
  return patterns;
}

py::object add_error(py::module_& module) {
  static PyObject* const error = PyErr_NewExceptionWithDoc(
      "launch_trace.TraceError", "A trace can't be read, or not to its end.", PyExc_RuntimeError, nullptr);
  module.attr("TraceError") = py::handle(error);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) {
        std::rethrow_exception(thrown);
      }
    } catch (const TraceReadError& failure) {
      set_error(failure, error);
    }
  });
  return py::reinterpret_borrow<py::object>(error);
}

}  // namespace

PYBIND11_MODULE(_events, module) {
  module.doc() =
      "Reads the traces of LTTng: the events and losses of one or several directories, in the order of time.\n\n"
      "    trace = launch_trace.Trace('traces/run')\n"
      "    for event in trace.events('ros2:callback_*'):\n"
      "        print(event.time_ns, event.name, event['callback'])\n"
      "    starts = trace.columns('ros2:callback_start', ['time_ns', 'callback'])";
  const py::object iterator_type = make_iterator_type(add_error(module));
  add_buffer_type(module);
  add_loss_type(module);
  const py::object event_type = make_event_type();
  module.attr("Event") = event_type;

  py::class_<Trace>(module, "Trace", "The traces at and below a directory, or a list of directories.")
      .def(py::init([event_type, iterator_type](const Directories& directories, bool damage_is_error) {
             return std::make_unique<Trace>(ReadingOptions{all_of(directories), damage_is_error, event_type},
                                            iterator_type);
           }),
           py::arg("directories"), py::kw_only(), py::arg("damage_is_error") = true,
           "Raises TraceError when there is no trace. Where a trace is damaged, all that stands beside the damage is\n"
           "read; the end of the reading then raises TraceError, unless damage_is_error is False.")
      .def(
          "__iter__", [](const Trace& trace) { return trace.iterate({}); },
          "All events and losses in the order of time, each time anew.")
      .def(
          "events", [](const Trace& trace, const py::args& patterns) { return trace.iterate(patterns_of(patterns)); },
          "events(*patterns): only the events whose names match a pattern with * and ?, and no losses.")
      .def("columns", &Trace::columns, py::arg("event"), py::arg("fields") = py::none(),
           "A dict of the values of these fields in all events of one name. Beside the fields there are time_ns,\n"
           "cpu_id, vpid, vtid, procname, host and other contexts; a number that was not recorded is -1. Columns are\n"
           "arrays of NumPy where it is installed; otherwise memoryviews of numbers, and lists of anything else.")
      .def_property_readonly("directories", [](const Trace& trace) { return trace.directories(); })
      .def_property_readonly(
          "damage", [](const Trace& trace) { return trace.findings().damage; },
          "What the last complete reading could not read, a line each.")
      .def_property_readonly(
          "lacks_descriptions", [](const Trace& trace) { return trace.findings().lacks_descriptions; },
          "The last complete reading left events of an open trace out, because the tracer has not described them yet.")
      .def_property_readonly(
          "open_directories", [](const Trace& trace) { return trace.findings().open_directories; },
          "The directories that were being written when the last reading began: they end with the last packet that\n"
          "was complete.");
}

}  // namespace tracing::python
