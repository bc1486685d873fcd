// SPDX-License-Identifier: Apache-2.0
// The classes that the libraries of this process have to offer.
#pragma once

#include <string>
#include <typeinfo>
#include <vector>

namespace class_loader::detail {

// A static object in the library of the class, made by CLASS_LOADER_REGISTER_CLASS.
class Registration {
 public:
  // The pointer that `create` returns is one to the base class.
  using Create = void* (*)();

  Registration(const char* class_name, const std::type_info& base, Create create);
  ~Registration();
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;

  const std::string class_name;
  const std::string base;  // by its name: libraries may have a type_info each
  const Create create;
  const std::string library;  // as the dynamic loader names it
  const bool is_linked;       // not of a library that a loader has loaded
};

// While one lives, what this thread registers is of libraries that are loaded at run time.
class Loading {
 public:
  Loading();
  ~Loading();
  Loading(const Loading&) = delete;
  Loading& operator=(const Loading&) = delete;
};

// The library "" stands for all that the program was linked with.

// Those with the base class in the library, in the order in which they were registered.
std::vector<std::string> classes_in(const std::string& library, const std::type_info& base);
// Null if there is no such class.
Registration::Create find_class(const std::string& library, const std::type_info& base, const std::string& class_name);

}  // namespace class_loader::detail
