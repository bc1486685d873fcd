// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/python_api/column.hpp"

#include <pybind11/numpy.h>

#include <utility>

#include "tracing/decode/python_api/field_object.hpp"

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

}  // namespace

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

void add_buffer_type(py::module_& module) {
  add_numbers_type<std::uint64_t>(module, "_UnsignedNumbers");
  add_numbers_type<std::int64_t>(module, "_SignedNumbers");
  add_numbers_type<double>(module, "_RealNumbers");
}

}  // namespace tracing::python
