// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/python_api/reading.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <exception>

#include "tracing/decode/python_api/trace_columns.hpp"
#include "tracing/decode/reader/event_pattern.hpp"

namespace tracing::python {

namespace py = pybind11;

namespace {

struct LossObject {
  std::int64_t time_ns = 0;
  std::optional<std::int64_t> end_ns;
  std::string kind;
  std::optional<std::uint64_t> count;
  std::string stream;
};

py::object make_loss(const Loss& loss) {
  return py::cast(LossObject{loss.begin_ns.value_or(0), loss.end_ns,
                             loss.kind == Loss::Kind::kEvents ? "events" : "packets", loss.count, loss.stream->name});
}

}  // namespace

void add_loss_type(py::module_& module) {
  py::class_<LossObject>(module, "Loss", "Events that the tracer could not keep, according to the trace itself.")
      .def_readonly("time_ns", &LossObject::time_ns, "The earliest time at which the loss began")
      .def_readonly("end_ns", &LossObject::end_ns, "The latest time at which it had ended, or None")
      .def_readonly("kind", &LossObject::kind, "'events', or 'packets' with an unknown number of events each")
      .def_readonly("count", &LossObject::count, "How many; None: some, but the number is unknown")
      .def_readonly("stream", &LossObject::stream, "The file of the stream")
      .def("__repr__", [](const LossObject& loss) {
        return "<Loss of " + (loss.count ? std::to_string(*loss.count) : "some") + " " + loss.kind + " at " +
               std::to_string(loss.time_ns) + " ns>";
      });
}

Reading::Reading(const ReadingOptions& options, std::shared_ptr<Findings> findings, std::vector<std::string> patterns)
    : reader_(options.directories),
      damage_is_error_(options.damage_is_error),
      findings_(std::move(findings)),
      maker_(options.event_type, reader_),
      patterns_(std::move(patterns)) {
  *findings_ = {};
  findings_->open_directories = reader_.open_directories();
}

py::object Reading::next() {
  constexpr std::size_t kCheckSignals = 1 << 16;  // items
  while (const TraceItem item = reader_.next()) {
    if (++items_ % kCheckSignals == 0 && PyErr_CheckSignals() != 0) {
      throw py::error_already_set();
    }
    if (item.event != nullptr) {
      if (is_wanted(*item.event->event_class)) {
        return maker_.make(*item.event);
      }
    } else if (patterns_.empty()) {
      return make_loss(*item.loss);
    }
  }
  end();
  return {};
}

py::dict Reading::columns(const std::string& event, const std::optional<std::vector<std::string>>& names) {
  py::dict columns = read_columns(reader_, event, names);
  end();
  return columns;
}

void Reading::end() {
  findings_->damage = reader_.damage();
  findings_->lacks_descriptions = reader_.lacks_descriptions();
  if (damage_is_error_) {
    reader_.throw_damage();
  }
}

bool Reading::is_wanted(const EventClass& event_class) {
  if (patterns_.empty()) {
    return true;
  }
  return is_wanted_.of(event_class, [&] {
    return std::any_of(patterns_.begin(), patterns_.end(),
                       [&](const std::string& pattern) { return matches_pattern(pattern, event_class.name); });
  });
}

namespace {

// Made with Python's own functions: a call through pybind11 takes as long as the making of an event.
struct IteratorObject {
  PyObject_HEAD Reading* reading;  // null: it has ended
};

PyObject* trace_error = nullptr;

IteratorObject* as_iterator(PyObject* object) {
  return reinterpret_cast<IteratorObject*>(object);
}

void deallocate_iterator(PyObject* object) {
  delete as_iterator(object)->reading;
  PyTypeObject* const type = Py_TYPE(object);
  type->tp_free(object);
  Py_DECREF(type);
}

void end_iterator(PyObject* object) {
  delete as_iterator(object)->reading;
  as_iterator(object)->reading = nullptr;
}

PyObject* next_item(PyObject* object) {
  Reading* const reading = as_iterator(object)->reading;
  if (reading == nullptr) {
    return nullptr;
  }
  try {
    if (py::object item = reading->next()) {
      return item.release().ptr();
    }
  } catch (const TraceReadError& failure) {
    set_error(failure, trace_error);
  } catch (py::error_already_set& error) {
    error.restore();
    return nullptr;
  } catch (const std::exception& failure) {
    PyErr_SetString(PyExc_RuntimeError, failure.what());
  }
  end_iterator(object);
  return nullptr;
}

}  // namespace

py::object make_iterator_type(py::object error) {
  trace_error = error.release().ptr();
  PyType_Slot slots[] = {{Py_tp_dealloc, reinterpret_cast<void*>(deallocate_iterator)},
                         {Py_tp_iter, reinterpret_cast<void*>(PyObject_SelfIter)},
                         {Py_tp_iternext, reinterpret_cast<void*>(next_item)},
                         {0, nullptr}};
  PyType_Spec spec{"launch_trace._Reading", sizeof(IteratorObject), 0,
                   Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};
  PyObject* const type = PyType_FromSpec(&spec);
  if (type == nullptr) {
    throw py::error_already_set();
  }
  return py::reinterpret_steal<py::object>(type);
}

py::object make_iterator(const py::object& type, std::unique_ptr<Reading> reading) {
  auto* const of = reinterpret_cast<PyTypeObject*>(type.ptr());
  py::object made = py::reinterpret_steal<py::object>(of->tp_alloc(of, 0));
  if (!made) {
    throw py::error_already_set();
  }
  as_iterator(made.ptr())->reading = reading.release();
  return made;
}

void set_error(const TraceReadError& failure, py::handle error) {
  std::string text = failure.what();
  if (!failure.remedy().empty()) {
    text += "\n      = help: " + failure.remedy();
  }
  PyErr_SetString(error.ptr(), text.c_str());
}

}  // namespace tracing::python
