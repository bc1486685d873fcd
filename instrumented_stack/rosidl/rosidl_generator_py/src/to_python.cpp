// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "message_plan.hpp"
#include "rosidl_runtime_c/string.h"
#include "rosidl_runtime_c/u16string.h"

namespace rosidl_generator_py {
namespace {

using rosidl_typesupport_c::at;
using rosidl_typesupport_c::load;
using rosidl_typesupport_c::member;

template <typename Number>
Number get(const void* source) {
  Number value;
  std::memcpy(&value, source, sizeof value);
  return value;
}

PyObject* signed_number(const void* source, std::size_t size) {
  switch (size) {
    case 1:
      return PyLong_FromLong(get<std::int8_t>(source));
    case 2:
      return PyLong_FromLong(get<std::int16_t>(source));
    case 4:
      return PyLong_FromLong(get<std::int32_t>(source));
    default:
      return PyLong_FromLongLong(get<std::int64_t>(source));
  }
}

PyObject* unsigned_number(const void* source, std::size_t size) {
  switch (size) {
    case 1:
      return PyLong_FromLong(get<std::uint8_t>(source));
    case 2:
      return PyLong_FromLong(get<std::uint16_t>(source));
    case 4:
      return PyLong_FromUnsignedLong(get<std::uint32_t>(source));
    default:
      return PyLong_FromUnsignedLongLong(get<std::uint64_t>(source));
  }
}

PyObject* one(const FieldPlan& field, const void* source) {
  switch (field.kind) {
    case Kind::kSigned:
      return signed_number(source, field.field.element.size);
    case Kind::kUnsigned:
      return unsigned_number(source, field.field.element.size);
    case Kind::kFloating:
      return PyFloat_FromDouble(field.field.element.size == sizeof(double) ? get<double>(source) : get<float>(source));
    case Kind::kBool:
      return PyBool_FromLong(get<std::uint8_t>(source));
    case Kind::kOctet:
      return PyBytes_FromStringAndSize(static_cast<const char*>(source), 1);
    case Kind::kCharacter:
      return PyUnicode_FromOrdinal(get<std::uint8_t>(source));
    case Kind::kString: {
      // Whoever sent the bytes may have sent no UTF-8.
      const auto& text = *static_cast<const rosidl_runtime_c__String*>(source);
      return PyUnicode_DecodeUTF8(text.data, static_cast<Py_ssize_t>(text.size), "replace");
    }
    case Kind::kWideString: {
      const auto& text = *static_cast<const rosidl_runtime_c__U16String*>(source);
      int byte_order = PY_BIG_ENDIAN ? 1 : -1;
      return PyUnicode_DecodeUTF16(reinterpret_cast<const char*>(text.data),
                                   static_cast<Py_ssize_t>(text.size * sizeof(std::uint16_t)), "replace", &byte_order);
    }
    default: {
      const MessagePlan* nested = plan_of(*field.field.element.message);
      return nested != nullptr ? to_python(*nested, source) : nullptr;
    }
  }
}

// What `module` calls `name`: a borrowed reference, or null with an exception. `kept` keeps it. It is no static
// variable with an initialiser: an import may let another thread run, which would wait for the end of the
// initialisation with Python's lock.
PyObject* imported(const char* module, const char* name, PyObject*& kept) {
  if (kept == nullptr) {
    const Reference imported(PyImport_ImportModule(module));
    PyObject* found = imported ? PyObject_GetAttrString(imported.get(), name) : nullptr;
    kept = kept != nullptr ? kept : found;
  }
  return kept;
}

// numpy.empty(count, dtype=type_code), filled.
PyObject* number_array(const FieldPlan& field, const void* elements) {
  static PyObject* kept = nullptr;
  PyObject* empty = imported("numpy", "empty", kept);
  if (empty == nullptr) {
    PyErr_SetString(PyExc_ImportError, "arrays of numbers in messages need numpy (Debian: python3-numpy)");
    return nullptr;
  }
  const char type_code[] = {field.type_code, '\0'};
  Reference array(PyObject_CallFunction(empty, "ns", static_cast<Py_ssize_t>(field.field.count), type_code));
  Py_buffer buffer;
  if (!array || PyObject_GetBuffer(array.get(), &buffer, PyBUF_WRITABLE) != 0) {
    return nullptr;
  }
  std::memcpy(buffer.buf, elements, field.field.count * field.field.element.size);
  PyBuffer_Release(&buffer);
  return array.release();
}

// array.array(type_code, bytes)
PyObject* number_sequence(const FieldPlan& field, const void* elements, std::size_t count) {
  static PyObject* kept = nullptr;
  PyObject* array = imported("array", "array", kept);
  if (array == nullptr) {
    return nullptr;
  }
  return PyObject_CallFunction(array, "Cy#", field.type_code, count != 0 ? elements : "",
                               static_cast<Py_ssize_t>(count * field.field.element.size));
}

PyObject* many(const FieldPlan& field, const void* elements, std::size_t count) {
  if (field.is_number()) {
    return field.field.is_sequence() ? number_sequence(field, elements, count) : number_array(field, elements);
  }
  Reference list(PyList_New(static_cast<Py_ssize_t>(count)));
  for (std::size_t i = 0; list && i < count; ++i) {
    PyObject* item = one(field, at(field.field.element, elements, i));
    if (item == nullptr) {
      return nullptr;
    }
    PyList_SET_ITEM(list.get(), static_cast<Py_ssize_t>(i), item);
  }
  return list.release();
}

PyObject* value_of(const FieldPlan& field, const void* source) {
  if (field.field.shape == Field::kOne) {
    return one(field, source);
  }
  if (!field.field.is_sequence()) {
    return many(field, source, field.field.count);
  }
  const auto sequence = load(source);
  return many(field, sequence.data, sequence.size);
}

// Whether objects check what they are given later on: a constant of the package, by the environment.
PyObject* check_fields() {
  static PyObject* kept = nullptr;
  return imported("rosidl_generator_py", "CHECK_FIELDS", kept);
}

}  // namespace

PyObject* to_python(const MessagePlan& plan, const void* message) {
  static PyObject* const kCheckFields = PyUnicode_InternFromString("_check_fields");
  static PyObject* const kNoArguments = PyTuple_New(0);
  if (kCheckFields == nullptr || kNoArguments == nullptr || check_fields() == nullptr) {
    return nullptr;
  }
  // The constructor would make defaults that nobody needs.
  Reference object(plan.type->tp_new(plan.type, kNoArguments, nullptr));
  if (!object || PyObject_SetAttr(object.get(), kCheckFields, check_fields()) != 0) {
    return nullptr;
  }
  for (const FieldPlan& field : plan.fields) {
    const Reference value(value_of(field, member(message, field.field.offset)));
    if (!value || PyObject_SetAttr(object.get(), field.slot, value.get()) != 0) {
      return nullptr;
    }
  }
  return object.release();
}

}  // namespace rosidl_generator_py
