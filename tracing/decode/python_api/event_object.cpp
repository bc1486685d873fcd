// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/python_api/event_object.hpp"

#include <structmember.h>

#include <cstddef>

namespace tracing::python {

namespace py = pybind11;

namespace {

py::object owned(PyObject* object) {
  if (object == nullptr) {
    throw py::error_already_set();
  }
  return py::reinterpret_steal<py::object>(object);
}

// Nothing in it can refer back to it, so Python's collector of circles need not know it.
struct EventObject {
  PyObject_HEAD PyObject* name;
  PyObject* time_ns;
  PyObject* cpu_id;
  PyObject* vpid;
  PyObject* vtid;
  PyObject* procname;
  PyObject* host;
  PyObject* values;    // tuple
  PyObject* contexts;  // dict, or None where there are no others
  PyObject* fields;    // dict: name → index in values
};

EventObject* as_event(PyObject* object) {
  return reinterpret_cast<EventObject*>(object);
}

void deallocate(PyObject* object) {
  EventObject* const event = as_event(object);
  for (PyObject* const member : {event->name, event->time_ns, event->cpu_id, event->vpid, event->vtid, event->procname,
                                 event->host, event->values, event->contexts, event->fields}) {
    Py_XDECREF(member);
  }
  PyTypeObject* const type = Py_TYPE(object);
  type->tp_free(object);
  Py_DECREF(type);
}

// The borrowed value; null, without an exception, when the event has no such field.
PyObject* value_of(EventObject* event, PyObject* name) {
  if (PyObject* const index = PyDict_GetItemWithError(event->fields, name)) {
    return PyTuple_GET_ITEM(event->values, PyLong_AsSsize_t(index));
  }
  if (PyErr_Occurred() != nullptr || event->contexts == Py_None) {
    return nullptr;
  }
  return PyDict_GetItemWithError(event->contexts, name);
}

PyObject* subscript(PyObject* object, PyObject* name) {
  PyObject* const value = value_of(as_event(object), name);
  if (value == nullptr && PyErr_Occurred() == nullptr) {
    PyErr_Format(PyExc_KeyError, "%S has no field %R", as_event(object)->name, name);
  }
  Py_XINCREF(value);
  return value;
}

int contains(PyObject* object, PyObject* name) {
  if (value_of(as_event(object), name) != nullptr) {
    return 1;
  }
  return PyErr_Occurred() == nullptr ? 0 : -1;
}

Py_ssize_t length(PyObject* object) {
  return PyTuple_GET_SIZE(as_event(object)->values);
}

PyObject* iterate(PyObject* object) {
  return PyObject_GetIter(as_event(object)->fields);
}

PyObject* keys(PyObject* object, PyObject*) {
  return PyDict_Keys(as_event(object)->fields);
}

PyObject* get(PyObject* object, PyObject* arguments) {
  PyObject* name = nullptr;
  PyObject* other = Py_None;
  if (PyArg_ParseTuple(arguments, "O|O", &name, &other) == 0) {
    return nullptr;
  }
  PyObject* value = value_of(as_event(object), name);
  if (value == nullptr && PyErr_Occurred() != nullptr) {
    return nullptr;
  }
  if (value == nullptr) {
    value = other;
  }
  Py_INCREF(value);
  return value;
}

PyObject* represent(PyObject* object) {
  EventObject* const event = as_event(object);
  try {
    py::str text = py::str("<{} at {} ns").format(py::handle(event->name), py::handle(event->time_ns));
    for (const auto& [name, index] : py::reinterpret_borrow<py::dict>(event->fields)) {
      text = py::str("{} {}={!r}")
                 .format(text, name, py::handle(PyTuple_GET_ITEM(event->values, index.cast<Py_ssize_t>())));
    }
    return (text + py::str(">")).release().ptr();
  } catch (py::error_already_set& error) {
    error.restore();
    return nullptr;
  }
}

PyMemberDef members[] = {
    {"name", T_OBJECT, offsetof(EventObject, name), READONLY, "Its name, such as 'ros2:callback_start'"},
    {"time_ns", T_OBJECT, offsetof(EventObject, time_ns), READONLY, "Nanoseconds since the epoch"},
    {"cpu_id", T_OBJECT, offsetof(EventObject, cpu_id), READONLY, "The processor, or None"},
    {"vpid", T_OBJECT, offsetof(EventObject, vpid), READONLY, "The id of the process, or None if not recorded"},
    {"vtid", T_OBJECT, offsetof(EventObject, vtid), READONLY, "The id of the thread, or None if not recorded"},
    {"procname", T_OBJECT, offsetof(EventObject, procname), READONLY, "The name of the thread, or None"},
    {"host", T_OBJECT, offsetof(EventObject, host), READONLY, "The name of the machine"},
    {"values", T_OBJECT, offsetof(EventObject, values), READONLY, "The values of the fields, in their order"},
    {"contexts", T_OBJECT, offsetof(EventObject, contexts), READONLY, "A dict of all other contexts, or None"},
    {nullptr, 0, 0, 0, nullptr}};

PyMethodDef methods[] = {{"keys", keys, METH_NOARGS, "The names of the fields, so that dict(event) works"},
                         {"get", get, METH_VARARGS, "get(name, other=None): the value of a field, or `other`"},
                         {nullptr, nullptr, 0, nullptr}};

template <class Function>
void* slot(Function* function) {
  return reinterpret_cast<void*>(function);
}

PyObject* reference(const py::object& object) {
  return object.inc_ref().ptr();
}

}  // namespace

py::object text_object(std::string_view text) {
  return owned(PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
}

py::object field_object(const FieldValue& value) {
  if (value.is_enumeration()) {
    if (const auto label = value.enumeration_label()) {
      return text_object(*label);
    }
  }
  if (const auto number = value.unsigned_integer()) {
    return owned(PyLong_FromUnsignedLongLong(*number));
  }
  if (const auto number = value.integer()) {
    return owned(PyLong_FromLongLong(*number));
  }
  if (const auto text = value.string()) {
    return text_object(*text);
  }
  if (const auto real = value.real()) {
    return owned(PyFloat_FromDouble(*real));
  }
  if (value.is_variant()) {
    return field_object(value[0]);
  }
  if (value.is_structure()) {
    py::dict fields;
    for (std::size_t i = 0; i < value.size(); ++i) {
      fields[text_object(value.member_name(i))] = field_object(value[i]);
    }
    return fields;
  }
  py::tuple elements(value.size());
  for (std::size_t i = 0; i < value.size(); ++i) {
    elements[i] = field_object(value[i]);
  }
  return elements;
}

py::object make_event_type() {
  static const char* const kDoc = "An event of a trace. event['field'] is the value of a field or a context.";
  PyType_Slot slots[] = {{Py_tp_dealloc, slot(deallocate)},  {Py_tp_doc, const_cast<char*>(kDoc)},
                         {Py_tp_members, members},           {Py_tp_methods, methods},
                         {Py_tp_repr, slot(represent)},      {Py_tp_iter, slot(iterate)},
                         {Py_mp_subscript, slot(subscript)}, {Py_mp_length, slot(length)},
                         {Py_sq_contains, slot(contains)},   {0, nullptr}};
  PyType_Spec spec{"launch_trace.Event", sizeof(EventObject), 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION,
                   slots};
  PyObject* const type = PyType_FromSpec(&spec);
  if (type == nullptr) {
    throw py::error_already_set();
  }
  return py::reinterpret_steal<py::object>(type);
}

EventMaker::EventMaker(py::object type, const TraceReader& reader) : type_(std::move(type)), reader_(reader) {}
EventMaker::~EventMaker() = default;

EventMaker::KnownClass EventMaker::facts_of(const EventClass& event_class) const {
  KnownClass known;
  known.name = text_object(event_class.name);
  known.host = text_object(reader_.traces()[event_class.trace].text("hostname"));
  for (std::size_t i = 0; i < event_class.fields.size(); ++i) {
    known.fields[text_object(event_class.fields[i])] = i;
  }
  py::list names;
  for (std::size_t i = 0; i < event_class.contexts.size(); ++i) {
    const std::string& context = event_class.contexts[i];
    if (context == "vpid" || context == "vtid" || context == "procname") {
      continue;
    }
    known.other_contexts.push_back(i);
    names.append(text_object(context));
  }
  known.context_names = names;
  return known;
}

PyObject* EventMaker::number_object(const std::optional<std::int64_t>& number, LastNumber& last) {
  if (number != last.value) {
    last.value = number;
    last.object = number ? py::object(py::int_(*number)) : py::object(py::none());
  }
  return reference(last.object);
}

PyObject* EventMaker::procname_object(const std::optional<std::string_view>& procname) {
  if (!procname) {
    return reference(py::none());
  }
  if (!last_procname_object_ || *procname != last_procname_) {
    last_procname_ = *procname;
    const auto [known, is_new] = procnames_.try_emplace(last_procname_);
    if (is_new) {
      known->second = text_object(*procname);
    }
    last_procname_object_ = known->second;
  }
  return reference(last_procname_object_);
}

py::object EventMaker::make(const Event& event) {
  const KnownClass& known = classes_.of(*event.event_class, [&] { return facts_of(*event.event_class); });
  auto* const type = reinterpret_cast<PyTypeObject*>(type_.ptr());
  py::object made = py::reinterpret_steal<py::object>(type->tp_alloc(type, 0));
  if (!made) {
    throw py::error_already_set();
  }
  EventObject* const object = as_event(made.ptr());
  object->name = reference(known.name);
  object->host = reference(known.host);
  object->fields = reference(known.fields);
  object->time_ns = PyLong_FromLongLong(event.timestamp_ns);
  object->cpu_id = event.cpu_id ? PyLong_FromLongLong(*event.cpu_id) : reference(py::none());  // a small one is shared
  object->vpid = number_object(event.vpid, last_vpid_);
  object->vtid = number_object(event.vtid, last_vtid_);
  object->procname = procname_object(event.procname);
  py::tuple values(event.event_class->fields.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    PyTuple_SET_ITEM(values.ptr(), static_cast<Py_ssize_t>(i), field_object(event.field(i)).release().ptr());
  }
  object->values = values.release().ptr();
  if (known.other_contexts.empty()) {
    object->contexts = reference(py::none());
  } else {
    py::dict contexts;
    for (std::size_t i = 0; i < known.other_contexts.size(); ++i) {
      contexts[known.context_names[i]] = field_object(event.context(known.other_contexts[i]));
    }
    object->contexts = contexts.release().ptr();
  }
  return made;
}

}  // namespace tracing::python
