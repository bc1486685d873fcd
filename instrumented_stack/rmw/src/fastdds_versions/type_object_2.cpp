// SPDX-License-Identifier: Apache-2.0
#include "fastdds_versions/names.hpp"
#include "fastdds_versions/type_object.hpp"

#if RMW_FASTDDS_MAJOR < 3

#include <fastrtps/types/DynamicTypeBuilder.h>
#include <fastrtps/types/DynamicTypeBuilderFactory.h>
#include <fastrtps/types/DynamicTypeBuilderPtr.h>
#include <fastrtps/types/DynamicTypePtr.h>
#include <fastrtps/types/TypeObject.h>
#include <fastrtps/types/TypeObjectFactory.h>

#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>

namespace types = eprosima::fastrtps::types;

namespace rmw_fastrtps {

namespace {

// 0 would mean Fast DDS's own small defaults.
constexpr std::uint32_t kUnbounded = std::numeric_limits<std::int32_t>::max();

types::DynamicType_ptr struct_of(const rosidl_type_description_t& description);

types::DynamicType_ptr element_of(const rosidl_field_description_t& field) {
  auto* factory = types::DynamicTypeBuilderFactory::get_instance();
  switch (field.type_id % kManyFactor) {
    case kNested:
      return struct_of(*field.nested_type);
    case kInt8:  // the dynamic types of Fast DDS 2.9 have no small integers
    case kUint8:
    case kByte:
      return factory->create_byte_type();
    case kInt16:
      return factory->create_int16_type();
    case kUint16:
      return factory->create_uint16_type();
    case kInt32:
      return factory->create_int32_type();
    case kUint32:
      return factory->create_uint32_type();
    case kInt64:
      return factory->create_int64_type();
    case kUint64:
      return factory->create_uint64_type();
    case kFloat:
      return factory->create_float32_type();
    case kDouble:
      return factory->create_float64_type();
    case kBoolean:
      return factory->create_bool_type();
    case kString:
    case kBoundedString:
      return factory->create_string_type(kUnbounded);
    case kWstring:
    case kBoundedWstring:
      return factory->create_wstring_type(kUnbounded);
    default:
      throw std::runtime_error(std::string("messages with a field such as '") + field.name +
                               "' cannot be filtered by content");
  }
}

types::DynamicType_ptr type_of(const rosidl_field_description_t& field) {
  auto* factory = types::DynamicTypeBuilderFactory::get_instance();
  const types::DynamicType_ptr element = element_of(field);
  switch (field.type_id / kManyFactor) {
    case kOne:
      return element;
    case kArray: {
      types::DynamicTypeBuilder_ptr array(
          factory->create_array_builder(element, {static_cast<std::uint32_t>(field.capacity)}));
      return array->build();
    }
    default: {
      const bool bounded = field.type_id / kManyFactor == kBoundedSequence;
      types::DynamicTypeBuilder_ptr sequence(
          factory->create_sequence_builder(element, bounded ? static_cast<std::uint32_t>(field.capacity) : kUnbounded));
      return sequence->build();
    }
  }
}

types::DynamicType_ptr struct_of(const rosidl_type_description_t& description) {
  types::DynamicTypeBuilder_ptr builder(types::DynamicTypeBuilderFactory::get_instance()->create_struct_builder());
  builder->set_name(dds_name(description.type_name));
  for (std::size_t i = 0; i < description.field_count; ++i) {
    builder->add_member(static_cast<types::MemberId>(i), description.fields[i].name, type_of(description.fields[i]));
  }
  return builder->build();
}

void register_struct(const rosidl_type_description_t& description) {
  auto* objects = types::TypeObjectFactory::get_instance();
  const std::string name = dds_name(description.type_name);
  if (objects->get_type_object(name, true) != nullptr) {
    return;
  }
  // Fast DDS looks for the elements of sequences by name, and crashes if it does not find them.
  for (std::size_t i = 0; i < description.field_count; ++i) {
    if (description.fields[i].nested_type != nullptr) {
      register_struct(*description.fields[i].nested_type);
    }
  }
  // Registers both forms: filters read the complete one, and a sequence of such structs is found by the minimal one.
  const types::DynamicType_ptr type = struct_of(description);
  for (const bool complete : {false, true}) {
    types::TypeObject object;
    types::DynamicTypeBuilderFactory::get_instance()->build_type_object(type, object, complete);
  }
  if (objects->get_type_object(name, true) == nullptr) {
    throw std::runtime_error("Fast DDS cannot describe type '" + name + "'");
  }
}

}  // namespace

void register_type_object(const rosidl_type_description_t& description) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  register_struct(description);
}

}  // namespace rmw_fastrtps

#endif
