// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace rosidl_runtime_cpp {

// A std::vector of at most UpperBound elements. A function that would exceed the bound throws std::length_error and
// changes nothing.
template <typename T, std::size_t UpperBound, typename Allocator = std::allocator<T>>
class BoundedVector : protected std::vector<T, Allocator> {
  using Base = std::vector<T, Allocator>;

 public:
  using typename Base::allocator_type;
  using typename Base::const_iterator;
  using typename Base::const_pointer;
  using typename Base::const_reference;
  using typename Base::const_reverse_iterator;
  using typename Base::difference_type;
  using typename Base::iterator;
  using typename Base::pointer;
  using typename Base::reference;
  using typename Base::reverse_iterator;
  using typename Base::size_type;
  using typename Base::value_type;

  BoundedVector() = default;
  explicit BoundedVector(const Allocator& allocator) noexcept : Base(allocator) {}
  explicit BoundedVector(size_type count, const Allocator& allocator = Allocator()) : Base(checked(count), allocator) {}
  BoundedVector(size_type count, const T& value, const Allocator& allocator = Allocator())
      : Base(checked(count), value, allocator) {}
  BoundedVector(std::initializer_list<T> values, const Allocator& allocator = Allocator())
      : Base((checked(values.size()), values), allocator) {}
  template <typename Iterator, typename = typename std::iterator_traits<Iterator>::iterator_category>
  BoundedVector(Iterator first, Iterator last, const Allocator& allocator = Allocator()) : Base(allocator) {
    assign(first, last);
  }

  BoundedVector& operator=(std::initializer_list<T> values) {
    assign(values);
    return *this;
  }

  using Base::at;
  using Base::back;
  using Base::begin;
  using Base::capacity;
  using Base::cbegin;
  using Base::cend;
  using Base::clear;
  using Base::crbegin;
  using Base::crend;
  using Base::empty;
  using Base::end;
  using Base::erase;
  using Base::front;
  using Base::get_allocator;
  using Base::operator[];
  using Base::pop_back;
  using Base::rbegin;
  using Base::rend;
  using Base::shrink_to_fit;
  using Base::size;

  // Templates, because std::vector<bool> has no data().
  template <typename U = T, typename = std::enable_if_t<!std::is_same_v<U, bool>>>
  U* data() noexcept {
    return Base::data();
  }
  template <typename U = T, typename = std::enable_if_t<!std::is_same_v<U, bool>>>
  const U* data() const noexcept {
    return Base::data();
  }

  static constexpr size_type max_size() noexcept { return UpperBound; }

  void reserve(size_type count) { Base::reserve(checked(count)); }
  void resize(size_type count) { Base::resize(checked(count)); }
  void resize(size_type count, const T& value) { Base::resize(checked(count), value); }

  void assign(size_type count, const T& value) { Base::assign(checked(count), value); }
  void assign(std::initializer_list<T> values) {
    checked(values.size());
    Base::assign(values);
  }
  template <typename Iterator, typename = typename std::iterator_traits<Iterator>::iterator_category>
  void assign(Iterator first, Iterator last) {
    Base values(first, last, get_allocator());
    checked(values.size());
    Base::swap(values);
  }

  void push_back(const T& value) {
    checked(size() + 1);
    Base::push_back(value);
  }
  void push_back(T&& value) {
    checked(size() + 1);
    Base::push_back(std::move(value));
  }
  template <typename... Arguments>
  decltype(auto) emplace_back(Arguments&&... arguments) {
    checked(size() + 1);
    return Base::emplace_back(std::forward<Arguments>(arguments)...);
  }
  template <typename... Arguments>
  iterator emplace(const_iterator position, Arguments&&... arguments) {
    checked(size() + 1);
    return Base::emplace(position, std::forward<Arguments>(arguments)...);
  }
  iterator insert(const_iterator position, const T& value) {
    checked(size() + 1);
    return Base::insert(position, value);
  }
  template <typename Iterator, typename = typename std::iterator_traits<Iterator>::iterator_category>
  iterator insert(const_iterator position, Iterator first, Iterator last) {
    Base values(first, last, get_allocator());
    checked(size() + values.size());
    return Base::insert(position, std::make_move_iterator(values.begin()), std::make_move_iterator(values.end()));
  }

  void swap(BoundedVector& other) noexcept { Base::swap(other); }
  friend void swap(BoundedVector& a, BoundedVector& b) noexcept { a.swap(b); }

  friend bool operator==(const BoundedVector& a, const BoundedVector& b) { return a.base() == b.base(); }
  friend bool operator!=(const BoundedVector& a, const BoundedVector& b) { return !(a == b); }
  friend bool operator<(const BoundedVector& a, const BoundedVector& b) { return a.base() < b.base(); }

 private:
  const Base& base() const noexcept { return *this; }

  static size_type checked(size_type count) {
    if (count > UpperBound) {
      throw std::length_error("a sequence of this message holds at most " + std::to_string(UpperBound) +
                              " elements, not " + std::to_string(count));
    }
    return count;
  }
};

}  // namespace rosidl_runtime_cpp
