// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "memory.hpp"
#include "structures.hpp"

namespace rcl_yaml {
namespace {

using Allocator = rcutils_allocator_t;

template <typename T>
void copy_scalar(T*& target, const T* source, const Allocator& allocator) {
  if (source != nullptr) {
    target = zeroed<T>(allocator);
    *target = *source;
  }
}

// Calls `copy(values)` for the memory of a new array. An empty array has none.
template <typename ArrayT, typename CopyT>
void make_array(ArrayT*& array, std::size_t size, const Allocator& allocator, CopyT copy) {
  array = zeroed<ArrayT>(allocator);
  if (size != 0) {
    array->values = zeroed<std::remove_reference_t<decltype(*array->values)>>(allocator, size);
    array->size = size;
    copy(array->values);
  }
}

template <typename ArrayT>
void copy_array(ArrayT*& target, const ArrayT* source, const Allocator& allocator) {
  if (source != nullptr) {
    make_array(target, source->size, allocator,
               [source](auto* values) { std::copy_n(source->values, source->size, values); });
  }
}

template <typename ArrayT>
void clear_array(ArrayT*& array, const Allocator& allocator) {
  if (array != nullptr) {
    release(allocator, array->values);
    release(allocator, array);
  }
}

template <typename TextOfT>
void make_string_array(rcutils_string_array_t*& array, std::size_t size, const Allocator& allocator, TextOfT text_of) {
  array = zeroed<rcutils_string_array_t>(allocator);
  array->allocator = allocator;
  if (size != 0) {
    array->data = zeroed<char*>(allocator, size);
    array->size = size;
    for (std::size_t i = 0; i < size; ++i) {
      array->data[i] = copy_text(allocator, text_of(i));
    }
  }
}

// Fills an empty variant by the type of the value.
struct Fill {
  rcl_variant_t& variant;
  const Allocator& allocator;

  void operator()(bool value) const { copy_scalar(variant.bool_value, &value, allocator); }
  void operator()(std::int64_t value) const { copy_scalar(variant.integer_value, &value, allocator); }
  void operator()(double value) const { copy_scalar(variant.double_value, &value, allocator); }
  void operator()(const std::string& value) const { variant.string_value = copy_text(allocator, value); }
  void operator()(const std::vector<bool>& list) const { array(variant.bool_array_value, list); }
  void operator()(const std::vector<std::int64_t>& list) const { array(variant.integer_array_value, list); }
  void operator()(const std::vector<double>& list) const { array(variant.double_array_value, list); }
  void operator()(const std::vector<std::string>& list) const {
    make_string_array(variant.string_array_value, list.size(), allocator, [&list](std::size_t i) { return list[i]; });
  }
  void operator()(const std::vector<std::uint8_t>& list) const { array(variant.byte_array_value, list); }

  template <typename ArrayT, typename ListT>
  void array(ArrayT*& target, const ListT& list) const {
    make_array(target, list.size(), allocator, [&list](auto* values) { std::copy(list.begin(), list.end(), values); });
  }
};

}  // namespace

void clear_variant(rcl_variant_t& variant, const Allocator& allocator) {
  release(allocator, variant.bool_value);
  release(allocator, variant.integer_value);
  release(allocator, variant.double_value);
  release(allocator, variant.string_value);
  clear_array(variant.byte_array_value, allocator);
  clear_array(variant.bool_array_value, allocator);
  clear_array(variant.integer_array_value, allocator);
  clear_array(variant.double_array_value, allocator);
  if (variant.string_array_value != nullptr) {
    (void)rcutils_string_array_fini(variant.string_array_value);
    release(allocator, variant.string_array_value);
  }
}

void set_variant(rcl_variant_t& variant, const std::optional<ParameterValue>& value, const Allocator& allocator) {
  clear_variant(variant, allocator);
  if (value.has_value()) {
    std::visit(Fill{variant, allocator}, *value);
  }
}

void copy_variant(rcl_variant_t& target, const rcl_variant_t& source, const Allocator& allocator) {
  copy_scalar(target.bool_value, source.bool_value, allocator);
  copy_scalar(target.integer_value, source.integer_value, allocator);
  copy_scalar(target.double_value, source.double_value, allocator);
  if (source.string_value != nullptr) {
    target.string_value = copy_text(allocator, source.string_value);
  }
  copy_array(target.byte_array_value, source.byte_array_value, allocator);
  copy_array(target.bool_array_value, source.bool_array_value, allocator);
  copy_array(target.integer_array_value, source.integer_array_value, allocator);
  copy_array(target.double_array_value, source.double_array_value, allocator);
  if (const rcutils_string_array_t* strings = source.string_array_value; strings != nullptr) {
    make_string_array(target.string_array_value, strings->size, allocator,
                      [strings](std::size_t i) { return std::string(strings->data[i]); });
  }
}

}  // namespace rcl_yaml
