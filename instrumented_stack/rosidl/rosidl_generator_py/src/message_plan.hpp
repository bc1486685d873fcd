// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference.hpp"
#include "rosidl_typesupport_c/element.hpp"

// Which attribute of which class a field of a C message is. A plan lives as long as the process, as classes of messages
// do. All functions need Python's lock.
namespace rosidl_generator_py {

using rosidl_typesupport_c::Field;
using rosidl_typesupport_c::Layout;

// What a value is in Python. The kinds of numbers are those that arrays can have.
enum class Kind : std::uint8_t {
  kSigned,
  kUnsigned,
  kFloating,
  kBool,
  kOctet,
  kCharacter,
  kString,
  kWideString,
  kMessage
};

struct FieldPlan {
  Field field;
  Kind kind;
  // The attribute that holds the value: "_data" for the field "data". `name` is without the underscore.
  PyObject* slot;
  const char* name;
  // Of array.array and of numpy, for numbers.
  char type_code;

  [[nodiscard]] bool is_number() const { return kind <= Kind::kFloating; }
};

struct MessagePlan {
  const Layout* layout;
  PyTypeObject* type;
  std::vector<FieldPlan> fields;
};

// The plan of a layout. It is made when it is asked for first, with the class that rosidl_generator_py finds by the
// name of the type. Null, with an exception, if there is no such class or if its fields are others.
const MessagePlan* plan_of(const Layout& layout);

// The plan of the objects of a class, or of one that inherits from it. Null, with an exception, if there is none.
const MessagePlan* plan_of(PyTypeObject* type);

// Fills the message, which is initialised, from the object. False, with an exception that names the field, if a value
// does not fit. The message is then valid but incomplete.
bool from_python(const MessagePlan& plan, PyObject* object, void* message);

// Makes an object of the message: a new reference, or null with an exception.
PyObject* to_python(const MessagePlan& plan, const void* message);

}  // namespace rosidl_generator_py
