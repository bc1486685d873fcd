// SPDX-License-Identifier: Apache-2.0
// The values of one field of many events, as one array.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "tracing/decode/reader/event.hpp"

namespace tracing::python {

// The first value decides the kind of the column: integers without or with sign, real numbers, or objects of Python. A
// later value of another kind turns it into a column of objects.
class Column {
 public:
  void add(const FieldValue& value);
  void add(std::optional<std::int64_t> number);  // -1: there is none
  void add(std::optional<std::string_view> text);

  // An array of NumPy where it is installed. Otherwise a memoryview of the numbers, or a list of the objects.
  pybind11::object take();

 private:
  using Objects = std::vector<pybind11::object>;

  template <class Number>
  void add_number(Number number);
  void add_object(pybind11::object object);
  pybind11::object shared_text(std::string_view text);

  std::variant<std::monostate, std::vector<std::uint64_t>, std::vector<std::int64_t>, std::vector<double>, Objects>
      values_;
  std::unordered_map<std::string, pybind11::object> texts_;  // most columns of texts repeat a few
};

// Adds the type that memoryviews without NumPy are views of.
void add_buffer_type(pybind11::module_& module);

}  // namespace tracing::python
