// SPDX-License-Identifier: Apache-2.0
// Types of which no generated code is at hand when this program is built, for endpoints and for the messages that they
// give and take.
//
// Two libraries have these names. The one of this folder makes type supports from interface files, for middlewares that
// read messages by Fast CDR. That of programs/companion/ takes the libraries of the packages, whatever the middleware.
#pragma once

#include <rosidl_runtime_c/message_type_support_struct.h>
#include <rosidl_runtime_c/service_type_support_struct.h>

#include <memory>

#include "launcher/message_types/interface_type.hpp"

namespace launch {

// Must live as long as the endpoints and messages that use it.
class DescribedType {
 public:
  // Throws std::runtime_error if the middleware can't have the type.
  explicit DescribedType(std::shared_ptr<const MessageType> type);
  ~DescribedType();
  DescribedType(const DescribedType&) = delete;
  DescribedType& operator=(const DescribedType&) = delete;

  const std::shared_ptr<const MessageType>& type() const { return type_; }
  const rosidl_message_type_support_t& handle() const;

 private:
  friend class NativeMessage;
  struct Support;

  std::shared_ptr<const MessageType> type_;
  std::unique_ptr<Support> support_;
};

// A message in the form in which the middleware takes and gives messages of a type.
class NativeMessage {
 public:
  // To take one into it.
  explicit NativeMessage(const DescribedType& type);
  // To give it. Throws std::runtime_error if the value can't be written.
  NativeMessage(const DescribedType& type, const MessageValue& value);
  ~NativeMessage();
  NativeMessage(const NativeMessage&) = delete;
  NativeMessage& operator=(const NativeMessage&) = delete;

  void* data();
  // Throws std::runtime_error if the message can't be read.
  MessageValue value() const;

 private:
  struct Storage;

  [[maybe_unused]] const DescribedType& type_;  // one of the two libraries needs it
  std::unique_ptr<Storage> storage_;
};

class DescribedService {
 public:
  // Throws std::runtime_error if the middleware can't have the type.
  explicit DescribedService(const ServiceType& type);
  ~DescribedService();
  DescribedService(const DescribedService&) = delete;
  DescribedService& operator=(const DescribedService&) = delete;

  const DescribedType& request() const { return request_; }
  const DescribedType& response() const { return response_; }
  const rosidl_service_type_support_t& handle() const;

 private:
  struct Support;

  DescribedType request_;
  DescribedType response_;
  std::unique_ptr<Support> support_;
};

}  // namespace launch
