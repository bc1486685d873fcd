// SPDX-License-Identifier: Apache-2.0
// The arguments and the result of anything that can be called: functions, pointers to functions, lambdas, and the
// results of std::bind() for functions and members of classes.
#pragma once

#include <cstddef>
#include <functional>
#include <tuple>
#include <type_traits>

namespace rclcpp::function_traits {

// Lambdas and objects with one operator().
template <typename FunctionT>
struct function_traits : function_traits<decltype(&FunctionT::operator())> {};

template <typename ResultT, typename... ArgumentTs>
struct function_traits<ResultT(ArgumentTs...)> {
  using arguments = std::tuple<ArgumentTs...>;
  using return_type = ResultT;
  static constexpr std::size_t arity = sizeof...(ArgumentTs);
  template <std::size_t kIndex>
  using argument_type = std::tuple_element_t<kIndex, arguments>;
};

template <typename ResultT, typename... ArgumentTs>
struct function_traits<ResultT (*)(ArgumentTs...)> : function_traits<ResultT(ArgumentTs...)> {};
template <typename ResultT, typename ClassT, typename... ArgumentTs>
struct function_traits<ResultT (ClassT::*)(ArgumentTs...)> : function_traits<ResultT(ArgumentTs...)> {};
template <typename ResultT, typename ClassT, typename... ArgumentTs>
struct function_traits<ResultT (ClassT::*)(ArgumentTs...) const> : function_traits<ResultT(ArgumentTs...)> {};
template <typename FunctionT>
struct function_traits<FunctionT&> : function_traits<FunctionT> {};
template <typename FunctionT>
struct function_traits<FunctionT&&> : function_traits<FunctionT> {};

// std::bind(): what the bound function takes, as rclcpp has it, whatever is bound.
#ifdef __GLIBCXX__
template <typename ResultT, typename ClassT, typename... ArgumentTs, typename... BoundTs>
struct function_traits<std::_Bind<ResultT (ClassT::*(BoundTs...))(ArgumentTs...)>>
    : function_traits<ResultT(ArgumentTs...)> {};
template <typename ResultT, typename ClassT, typename... ArgumentTs, typename... BoundTs>
struct function_traits<std::_Bind<ResultT (ClassT::*(BoundTs...))(ArgumentTs...) const>>
    : function_traits<ResultT(ArgumentTs...)> {};
template <typename ResultT, typename... ArgumentTs, typename... BoundTs>
struct function_traits<std::_Bind<ResultT (*(BoundTs...))(ArgumentTs...)>> : function_traits<ResultT(ArgumentTs...)> {};
#endif

template <std::size_t kArity, typename FunctionT>
struct arity_comparator : std::bool_constant<kArity == function_traits<FunctionT>::arity> {};

template <typename FunctionT, typename... ArgumentTs>
struct check_arguments : std::is_same<typename function_traits<FunctionT>::arguments, std::tuple<ArgumentTs...>> {};

template <typename FunctionT, typename OtherT>
struct same_arguments
    : std::is_same<typename function_traits<FunctionT>::arguments, typename function_traits<OtherT>::arguments> {};

namespace detail {

template <typename ResultT, typename ArgumentsT>
struct StdFunctionOf;
template <typename ResultT, typename... ArgumentTs>
struct StdFunctionOf<ResultT, std::tuple<ArgumentTs...>> {
  using type = std::function<ResultT(ArgumentTs...)>;
};

}  // namespace detail

template <typename FunctionT, typename TraitsT = function_traits<FunctionT>>
struct as_std_function {
  using type = typename detail::StdFunctionOf<typename TraitsT::return_type, typename TraitsT::arguments>::type;
};

}  // namespace rclcpp::function_traits
