// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/python_api/field_object.hpp"

namespace tracing::python {

namespace py = pybind11;

namespace {

py::object owned(PyObject* object) {
  if (object == nullptr) {
    throw py::error_already_set();
  }
  return py::reinterpret_steal<py::object>(object);
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

}  // namespace tracing::python
