// SPDX-License-Identifier: Apache-2.0
// A message in the memory from which the middleware sends it, so that publishing does not copy it:
//
//   auto loan = publisher->borrow_loaned_message();
//   loan.get().data = 1;
//   publisher->publish(std::move(loan));
#pragma once

#include <rcl/publisher.h>

#include <functional>
#include <memory>
#include <new>
#include <rosidl_runtime_cpp/message_initialization.hpp>
#include <rosidl_typesupport_cpp/message_type_support.hpp>
#include <type_traits>
#include <utility>

#include "rclcpp/allocator/allocator_common.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/publisher_base.hpp"

namespace rclcpp {

// The initial content of a borrowed message is undefined. For types that are not plain (see
// PublisherBase::can_loan_messages()), and after shutdown, it holds an ordinary message. The publisher must outlive it.
// Not thread safe.
template <typename MessageT, typename AllocatorT = std::allocator<void>>
class LoanedMessage {
 public:
  // The allocator of messages is made from `allocator`. Throws exceptions::RCLError.
  template <typename OtherT = AllocatorT>
  explicit LoanedMessage(PublisherBase& publisher, const OtherT& allocator = OtherT())
      : publisher_handle_(publisher.get_publisher_handle()) {
    void* const memory =
        publisher.can_loan_messages()
            ? publisher.borrow_memory(rosidl_typesupport_cpp::get_message_type_support_handle<MessageT>())
            : nullptr;
    if (memory) {
      loan_ = new (memory) MessageT(rosidl_runtime_cpp::MessageInitialization::SKIP);
    } else {
      if constexpr (std::is_constructible_v<AllocatorT, const OtherT&>) {
        own_ = allocator::make_unique<MessageT>(AllocatorT(allocator));
      } else {
        own_ = allocator::make_unique<MessageT>(AllocatorT());
      }
    }
  }

  LoanedMessage(LoanedMessage&& other) noexcept
      : publisher_handle_(std::move(other.publisher_handle_)),
        loan_(std::exchange(other.loan_, nullptr)),
        own_(std::move(other.own_)) {}
  LoanedMessage(const LoanedMessage&) = delete;
  LoanedMessage& operator=(const LoanedMessage&) = delete;
  LoanedMessage& operator=(LoanedMessage&&) = delete;

  // Returns the loan if it was not published.
  virtual ~LoanedMessage() {
    if (loan_ && rcl_return_loaned_message_from_publisher(publisher_handle_.get(), loan_) != RCL_RET_OK) {
      RCLCPP_ERROR(get_logger("rclcpp"), "failed to return a loaned message: %s", rcl_get_error_string().str);
      rcl_reset_error();
    }
  }

  bool is_valid() const { return loan_ || own_; }
  MessageT& get() const { return loan_ ? *loan_ : *own_; }

  // Gives the message up. An ordinary message is freed with the pointer; a loan is not, so publish it, or return it
  // with rcl_return_loaned_message_from_publisher().
  std::unique_ptr<MessageT, std::function<void(MessageT*)>> release() {
    if (loan_) {
      return {std::exchange(loan_, nullptr), [](MessageT*) {}};
    }
    auto deleter = own_.get_deleter();
    return {own_.release(), [deleter](MessageT* message) mutable { deleter(message); }};
  }

  // For publishers: they take the loan (null if there is none) or the ordinary message.
  MessageT* release_loan() { return std::exchange(loan_, nullptr); }
  allocator::UniquePtr<MessageT, AllocatorT> release_own() { return std::move(own_); }

 private:
  std::shared_ptr<rcl_publisher_t> publisher_handle_;
  MessageT* loan_ = nullptr;
  allocator::UniquePtr<MessageT, AllocatorT> own_;
};

}  // namespace rclcpp
