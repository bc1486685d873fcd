// SPDX-License-Identifier: Apache-2.0
// The classes that the libraries of this process offer.
#pragma once

#include <string>
#include <typeinfo>
#include <vector>

namespace class_loader::detail {

// CLASS_LOADER_REGISTER_CLASS creates it as a static object in the library of the class.
class Registration {
 public:
  // A `Base* (*)(<constructor_parameters of Base>...)`: see interface_traits.hpp.
  using Create = void (*)();

  Registration(const char* class_name, const std::type_info& base, Create create);
  ~Registration();
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;

  const std::string class_name;
  const std::string base;  // by name: each library may have its own type_info
  const Create create;
  const std::string library;  // as in the dynamic loader
  const bool is_linked;       // the library was not loaded by a loader
};

// While one lives, registrations of this thread belong to libraries that are loaded at run time.
class Loading {
 public:
  Loading();
  ~Loading();
  Loading(const Loading&) = delete;
  Loading& operator=(const Loading&) = delete;
};

// The library "" means all libraries that the program was linked with.

// The classes of the library with the base class, in the order of registration.
std::vector<std::string> classes_in(const std::string& library, const std::type_info& base);
// Null if the class does not exist.
Registration::Create find_class(const std::string& library, const std::type_info& base, const std::string& class_name);

}  // namespace class_loader::detail
