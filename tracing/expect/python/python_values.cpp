// SPDX-License-Identifier: Apache-2.0
#include "tracing/expect/python/python_values.hpp"

namespace launch_trace_testing {

namespace py = pybind11;

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

}  // namespace launch_trace_testing
