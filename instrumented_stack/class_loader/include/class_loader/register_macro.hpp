// SPDX-License-Identifier: Apache-2.0
// Lets loaders create a class of this library:
//
//   CLASS_LOADER_REGISTER_CLASS(shapes::Square, shapes::Shape)
//
// in one source file, outside every namespace. The class has a constructor with
// the arguments that InterfaceTraits of its base class tells: without any, if it tells none.
#pragma once

#include "class_loader/detail/class_registry.hpp"
#include "class_loader/interface_traits.hpp"

#define CLASS_LOADER_REGISTER_CLASS(Derived, Base) CLASS_LOADER_REGISTER_CLASS_COUNTED(Derived, Base, __COUNTER__)
// In ROS 2 the message is logged when the library is loaded; here it is not.
#define CLASS_LOADER_REGISTER_CLASS_WITH_MESSAGE(Derived, Base, Message) \
  CLASS_LOADER_REGISTER_CLASS_COUNTED(Derived, Base, __COUNTER__)
// A separate macro level, because __COUNTER__ must be a number before it becomes part of a name.
#define CLASS_LOADER_REGISTER_CLASS_COUNTED(Derived, Base, number) \
  CLASS_LOADER_REGISTER_CLASS_NUMBERED(Derived, Base, number)
#define CLASS_LOADER_REGISTER_CLASS_NUMBERED(Derived, Base, number)                  \
  namespace {                                                                        \
  const ::class_loader::detail::Registration class_registration_##number(            \
      #Derived, typeid(Base), ::class_loader::detail::Factory<Base>::of<Derived>()); \
  }
