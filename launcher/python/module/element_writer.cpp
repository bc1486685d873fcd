// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/module/element_writer.hpp"

#include <variant>

namespace py = pybind11;

namespace launch::python {

namespace {

py::object write_value(const Value& value) {
  if (const auto* const list = std::get_if<std::vector<Value>>(&value.data)) {
    py::list items;
    for (const Value& item : *list) {
      items.append(write_value(item));
    }
    return items;
  }
  if (const auto* const text = std::get_if<Text>(&value.data)) {
    return text->parts.empty() ? py::object(py::none()) : py::object(py::str(text->parts.front().text));
  }
  if (const auto* const boolean = std::get_if<bool>(&value.data)) {
    return py::bool_(*boolean);
  }
  if (const auto* const whole = std::get_if<std::int64_t>(&value.data)) {
    return py::int_(*whole);
  }
  return py::float_(std::get<double>(value.data));
}

}  // namespace

py::tuple write_place(const Place& place) {
  return py::make_tuple(place.file, place.line, place.begin, place.end);
}

py::tuple write_element(const Element& element) {
  py::list attributes;
  for (const Element::Attribute& attribute : element.attributes) {
    attributes.append(py::make_tuple(attribute.name, write_value(attribute.value), write_place(attribute.value.where),
                                     write_place(attribute.name_where), attribute.untyped));
  }
  py::list children;
  for (const Element& child : element.children) {
    children.append(write_element(child));
  }
  return py::make_tuple(element.tag, write_place(element.where), attributes, children, element.number, element.is_item);
}

}  // namespace launch::python
