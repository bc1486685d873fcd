// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <limits>
#include <string_view>

#include "message_plan.hpp"
#include "rosidl_runtime_c/string_functions.h"
#include "rosidl_runtime_c/u16string_functions.h"

namespace rosidl_generator_py {
namespace {

using rosidl_typesupport_c::at;
using rosidl_typesupport_c::load;
using rosidl_typesupport_c::member;
using rosidl_typesupport_c::resize;

bool fail(PyObject* exception, const MessagePlan& plan, const FieldPlan& field, const char* must) {
  PyErr_Format(exception, "the field '%s' of %s %s", field.name, plan.layout->description->type_name, must);
  return false;
}

bool wrong_type(const MessagePlan& plan, const FieldPlan& field, const char* expected, PyObject* value) {
  PyErr_Format(PyExc_TypeError, "the field '%s' of %s must be %s, not %s", field.name,
               plan.layout->description->type_name, expected, Py_TYPE(value)->tp_name);
  return false;
}

template <typename Number>
void put(void* target, Number value) {
  std::memcpy(target, &value, sizeof value);
}

template <typename Wide>
bool put_integer(const MessagePlan& plan, const FieldPlan& field, Wide value, void* target) {
  const std::size_t bits = field.field.element.size * 8;
  constexpr std::size_t kWideBits = sizeof(Wide) * 8;
  // The value fits if it is the same after its upper bits are cut off.
  const auto cut = static_cast<Wide>(static_cast<std::uint64_t>(value) << (kWideBits - bits)) >> (kWideBits - bits);
  if (cut != value) {
    return fail(PyExc_OverflowError, plan, field, "does not fit its type");
  }
  switch (field.field.element.size) {
    case 1:
      put(target, static_cast<std::uint8_t>(value));
      break;
    case 2:
      put(target, static_cast<std::uint16_t>(value));
      break;
    case 4:
      put(target, static_cast<std::uint32_t>(value));
      break;
    default:
      put(target, static_cast<std::uint64_t>(value));
  }
  return true;
}

// An exception of Python's own conversion does not name the field.
bool name_field(const MessagePlan& plan, const FieldPlan& field, const char* expected, PyObject* value) {
  if (PyErr_ExceptionMatches(PyExc_OverflowError) != 0) {
    return fail(PyExc_OverflowError, plan, field, "does not fit its type");
  }
  return PyErr_ExceptionMatches(PyExc_TypeError) != 0 ? wrong_type(plan, field, expected, value) : false;
}

bool put_number(const MessagePlan& plan, const FieldPlan& field, PyObject* value, void* target) {
  if (field.kind == Kind::kFloating) {
    const double number = PyFloat_AsDouble(value);
    if (number == -1 && PyErr_Occurred() != nullptr) {
      return name_field(plan, field, "a float", value);
    }
    if (field.field.element.size == sizeof(double)) {
      put(target, number);
    } else {
      put(target, static_cast<float>(number));
    }
    return true;
  }
  const Reference index(PyNumber_Index(value));
  if (!index) {
    return name_field(plan, field, "an int", value);
  }
  if (field.kind == Kind::kSigned) {
    const long long number = PyLong_AsLongLong(index.get());
    if (number == -1 && PyErr_Occurred() != nullptr) {
      return name_field(plan, field, "an int", value);
    }
    return put_integer(plan, field, number, target);
  }
  const unsigned long long number = PyLong_AsUnsignedLongLong(index.get());
  if (number == std::numeric_limits<unsigned long long>::max() && PyErr_Occurred() != nullptr) {
    return name_field(plan, field, "an int", value);
  }
  return put_integer(plan, field, number, target);
}

bool put_string(const MessagePlan& plan, const FieldPlan& field, PyObject* value, void* target) {
  if (PyUnicode_Check(value) == 0) {
    return wrong_type(plan, field, "a str", value);
  }
  Py_ssize_t size = 0;
  const char* text = PyUnicode_AsUTF8AndSize(value, &size);
  if (text == nullptr) {
    return false;
  }
  if (!rosidl_runtime_c__String__assignn(static_cast<rosidl_runtime_c__String*>(target), text,
                                         static_cast<std::size_t>(size))) {
    PyErr_NoMemory();
    return false;
  }
  return true;
}

bool put_wide_string(const MessagePlan& plan, const FieldPlan& field, PyObject* value, void* target) {
  if (PyUnicode_Check(value) == 0) {
    return wrong_type(plan, field, "a str", value);
  }
  // Units in the order of bytes of this machine, without a mark of it.
  const Reference units(PyUnicode_AsEncodedString(value, PY_BIG_ENDIAN ? "utf-16-be" : "utf-16-le", "strict"));
  if (!units) {
    return false;
  }
  const auto size = static_cast<std::size_t>(PyBytes_GET_SIZE(units.get())) / sizeof(std::uint16_t);
  auto* text = static_cast<rosidl_runtime_c__U16String*>(target);
  if (!rosidl_runtime_c__U16String__resize(text, size)) {
    PyErr_NoMemory();
    return false;
  }
  std::memcpy(text->data, PyBytes_AS_STRING(units.get()), size * sizeof(std::uint16_t));
  return true;
}

bool put_one(const MessagePlan& plan, const FieldPlan& field, PyObject* value, void* target) {
  switch (field.kind) {
    case Kind::kBool: {
      const int truth = PyObject_IsTrue(value);
      put(target, truth > 0);
      return truth >= 0;
    }
    case Kind::kOctet:
      if (PyBytes_Check(value) == 0 || PyBytes_GET_SIZE(value) != 1) {
        return wrong_type(plan, field, "bytes of length 1", value);
      }
      put(target, PyBytes_AS_STRING(value)[0]);
      return true;
    case Kind::kCharacter:
      if (PyUnicode_Check(value) == 0 || PyUnicode_GetLength(value) != 1 || PyUnicode_ReadChar(value, 0) > 255) {
        return wrong_type(plan, field, "a str of one character below 256", value);
      }
      put(target, static_cast<std::uint8_t>(PyUnicode_ReadChar(value, 0)));
      return true;
    case Kind::kString:
      return put_string(plan, field, value, target);
    case Kind::kWideString:
      return put_wide_string(plan, field, value, target);
    case Kind::kMessage: {
      const MessagePlan* nested = plan_of(*field.field.element.message);
      if (nested == nullptr) {
        return false;
      }
      if (PyObject_TypeCheck(value, nested->type) == 0) {
        return wrong_type(plan, field, nested->layout->description->type_name, value);
      }
      return from_python(*nested, value, target);
    }
    default:
      return put_number(plan, field, value, target);
  }
}

// Whether the elements of a buffer are the numbers of the field, byte by byte.
bool has_same_elements(const FieldPlan& field, const Py_buffer& buffer) {
  if (buffer.ndim != 1 || buffer.format == nullptr ||
      static_cast<std::size_t>(buffer.itemsize) != field.field.element.size) {
    return false;
  }
  const char* format = buffer.format;
  if (*format == '@' || *format == '=' || *format == (PY_BIG_ENDIAN ? '>' : '<')) {
    ++format;
  }
  constexpr std::string_view kOfKind[] = {"bhilqn", "BHILQN", "fd"};
  return format[0] != '\0' && format[1] == '\0' &&
         kOfKind[static_cast<std::size_t>(field.kind)].find(*format) != std::string_view::npos;
}

// Makes room for the elements, or checks their number. Null, with an exception, if there are too many or too few.
void* room_for(const MessagePlan& plan, const FieldPlan& field, std::size_t size, void* value) {
  if (!field.field.is_sequence()) {
    if (size != field.field.count) {
      PyErr_Format(PyExc_ValueError, "the field '%s' of %s must have %zu elements, not %zu", field.name,
                   plan.layout->description->type_name, field.field.count, size);
      return nullptr;
    }
    return value;
  }
  if (field.field.shape == Field::kBoundedSequence && size > field.field.count) {
    PyErr_Format(PyExc_ValueError, "the field '%s' of %s must have at most %zu elements, not %zu", field.name,
                 plan.layout->description->type_name, field.field.count, size);
    return nullptr;
  }
  if (!resize(field.field.element, value, size)) {
    PyErr_NoMemory();
    return nullptr;
  }
  static char nothing;
  void* data = load(value).data;
  return data != nullptr ? data : &nothing;
}

enum class Copied : std::uint8_t { kYes, kNo, kFailed };

// Numbers in a contiguous buffer (array.array, numpy, bytes) are copied at once.
Copied copy_buffer(const MessagePlan& plan, const FieldPlan& field, PyObject* object, void* value) {
  Py_buffer buffer;
  if (!field.is_number() || PyObject_CheckBuffer(object) == 0) {
    return Copied::kNo;
  }
  if (PyObject_GetBuffer(object, &buffer, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT) != 0) {
    PyErr_Clear();
    return Copied::kNo;
  }
  Copied result = Copied::kNo;
  if (has_same_elements(field, buffer)) {
    void* target = room_for(plan, field, static_cast<std::size_t>(buffer.len / buffer.itemsize), value);
    result = target != nullptr ? Copied::kYes : Copied::kFailed;
    if (target != nullptr && buffer.len != 0) {
      std::memcpy(target, buffer.buf, static_cast<std::size_t>(buffer.len));
    }
  }
  PyBuffer_Release(&buffer);
  return result;
}

bool put_many(const MessagePlan& plan, const FieldPlan& field, PyObject* object, void* value) {
  const Copied copied = copy_buffer(plan, field, object, value);
  if (copied != Copied::kNo) {
    return copied == Copied::kYes;
  }
  const Reference items(PySequence_Fast(object, ""));
  if (!items) {
    return name_field(plan, field, "a sequence", object);
  }
  const auto size = static_cast<std::size_t>(PySequence_Fast_GET_SIZE(items.get()));
  void* target = room_for(plan, field, size, value);
  if (target == nullptr) {
    return false;
  }
  for (std::size_t i = 0; i < size; ++i) {
    PyObject* item = PySequence_Fast_GET_ITEM(items.get(), static_cast<Py_ssize_t>(i));
    if (!put_one(plan, field, item, at(field.field.element, target, i))) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool from_python(const MessagePlan& plan, PyObject* object, void* message) {
  for (const FieldPlan& field : plan.fields) {
    const Reference value(PyObject_GetAttr(object, field.slot));
    if (!value) {
      return false;
    }
    void* target = member(message, field.field.offset);
    if (!(field.field.shape == Field::kOne ? put_one(plan, field, value.get(), target)
                                           : put_many(plan, field, value.get(), target))) {
      return false;
    }
  }
  return true;
}

}  // namespace rosidl_generator_py
