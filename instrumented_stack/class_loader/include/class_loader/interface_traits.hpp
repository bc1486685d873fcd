// SPDX-License-Identifier: Apache-2.0
// The arguments that the constructors of plugins take. A base class that wants some has a specialisation:
//
//   template <>
//   struct class_loader::InterfaceTraits<Shape> {
//     using constructor_parameters = class_loader::ConstructorParameters<double, std::unique_ptr<Colour>>;
//   };
//
// Plugins of this base class then have a constructor with these parameters, and loaders pass the arguments:
//
//   loader.createUniqueInstance<Shape>("Square", 2.0, std::make_unique<Colour>());
#pragma once

#include <type_traits>
#include <utility>

namespace class_loader {

template <typename... Parameters>
struct ConstructorParameters {};

template <typename Base>
struct InterfaceTraits {
  using constructor_parameters = ConstructorParameters<>;
};

namespace detail {

template <typename Base, typename = typename InterfaceTraits<Base>::constructor_parameters>
struct Factory;

// Creates objects of classes of this base class. A registration keeps the function without its type.
template <typename Base, typename... Parameters>
struct Factory<Base, ConstructorParameters<Parameters...>> {
  using Function = Base* (*)(Parameters...);

  // Whether arguments of these types can be given.
  template <typename... Arguments>
  static constexpr bool takes = std::is_invocable_v<Function, Arguments...>;

  template <typename Derived>
  static auto of() -> void (*)() {
    const Function function = [](Parameters... parameters) -> Base* {
      return new Derived(std::forward<Parameters>(parameters)...);
    };
    return reinterpret_cast<void (*)()>(function);
  }

  template <typename... Arguments>
  static Base* create(void (*function)(), Arguments&&... arguments) {
    return reinterpret_cast<Function>(function)(std::forward<Arguments>(arguments)...);
  }
};

}  // namespace detail

}  // namespace class_loader
