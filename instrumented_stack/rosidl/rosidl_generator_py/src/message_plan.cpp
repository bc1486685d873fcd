// SPDX-License-Identifier: Apache-2.0
#include "message_plan.hpp"

#include <cstring>
#include <memory>
#include <string>
#include <unordered_map>

#include "rosidl_runtime_c/type_description.h"

namespace rosidl_generator_py {
namespace {

// A message without fields has one in C, which is none in Python.
constexpr const char* kPlaceholder = "structure_needs_at_least_one_member";

template <typename Key>
using Plans = std::unordered_map<Key, const MessagePlan*>;

Plans<const Layout*>& plans_of_layouts() {
  static Plans<const Layout*> plans;
  return plans;
}

Plans<PyTypeObject*>& plans_of_types() {
  static Plans<PyTypeObject*> plans;
  return plans;
}

// The offsets of arrays and sequences in type_description_interfaces/msg/FieldType are multiples of this.
constexpr std::uint8_t kShapeOffset = 48;

struct ElementKind {
  Kind kind;
  char type_code;
};

// By the constants of type_description_interfaces/msg/FieldType.
ElementKind element_kind(std::uint8_t type_id) {
  switch (type_id % kShapeOffset) {
    case 2:
      return {Kind::kSigned, 'b'};
    case 3:
      return {Kind::kUnsigned, 'B'};
    case 4:
      return {Kind::kSigned, 'h'};
    case 5:
      return {Kind::kUnsigned, 'H'};
    case 6:
      return {Kind::kSigned, 'i'};
    case 7:
      return {Kind::kUnsigned, 'I'};
    case 8:
      return {Kind::kSigned, 'q'};
    case 9:
      return {Kind::kUnsigned, 'Q'};
    case 10:
      return {Kind::kFloating, 'f'};
    case 11:
      return {Kind::kFloating, 'd'};
    case 13:
      return {Kind::kCharacter, '\0'};
    case 15:
      return {Kind::kBool, '\0'};
    case 16:
      return {Kind::kOctet, '\0'};
    case 17:
    case 21:
      return {Kind::kString, '\0'};
    case 18:
    case 22:
      return {Kind::kWideString, '\0'};
    default:
      return {Kind::kMessage, '\0'};
  }
}

// The class of a type such as std_msgs/msg/Header.
Reference class_of(const char* type_name) {
  const Reference module(PyImport_ImportModule("rosidl_generator_py"));
  if (!module) {
    return {};
  }
  Reference type(PyObject_CallMethod(module.get(), "class_of", "s", type_name));
  if (type && PyType_Check(type.get()) == 0) {
    PyErr_Format(PyExc_TypeError, "%s is not a class of messages", type_name);
    return {};
  }
  return type;
}

bool add_fields(const Layout& layout, MessagePlan& plan) {
  for (std::size_t i = 0; i < layout.description->field_count; ++i) {
    const rosidl_field_description_t& description = layout.description->fields[i];
    if (std::strcmp(description.name, kPlaceholder) == 0) {
      continue;
    }
    const std::string attribute = std::string("_") + description.name;
    PyObject* slot = PyUnicode_InternFromString(attribute.c_str());
    if (slot == nullptr) {
      return false;
    }
    const ElementKind kind = element_kind(description.type_id);
    plan.fields.push_back(
        {rosidl_typesupport_c::field_of(layout, i), kind.kind, slot, description.name, kind.type_code});
    if (PyObject_HasAttr(reinterpret_cast<PyObject*>(plan.type), slot) == 0) {
      PyErr_Format(PyExc_ImportError,
                   "the class %s has no field '%s', but the library of its package has: they are of different versions",
                   plan.type->tp_name, description.name);
      return false;
    }
  }
  return true;
}

}  // namespace

const MessagePlan* plan_of(const Layout& layout) {
  const auto found = plans_of_layouts().find(&layout);
  if (found != plans_of_layouts().end()) {
    return found->second;
  }
  Reference type = class_of(layout.description->type_name);
  if (!type) {
    return nullptr;
  }
  auto plan = std::make_unique<MessagePlan>();
  plan->layout = &layout;
  plan->type = reinterpret_cast<PyTypeObject*>(type.get());
  if (!add_fields(layout, *plan)) {
    return nullptr;
  }
  type.release();  // the plan keeps the class
  plans_of_types().emplace(plan->type, plan.get());
  return plans_of_layouts().emplace(&layout, plan.release()).first->second;
}

const MessagePlan* plan_of(PyTypeObject* type) {
  for (PyTypeObject* base = type; base != nullptr; base = base->tp_base) {
    const auto found = plans_of_types().find(base);
    if (found != plans_of_types().end()) {
      return found->second;
    }
  }
  PyErr_Format(PyExc_TypeError, "%s is not a class of messages whose type support was imported", type->tp_name);
  return nullptr;
}

}  // namespace rosidl_generator_py
