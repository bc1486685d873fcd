// SPDX-License-Identifier: Apache-2.0
#include "fastdds_versions/names.hpp"
#include "fastdds_versions/type_object.hpp"

#if RMW_FASTDDS_MAJOR >= 3

#include <fastdds/dds/core/Types.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/xtypes/dynamic_types/DynamicType.hpp>
#include <fastdds/dds/xtypes/dynamic_types/DynamicTypeBuilder.hpp>
#include <fastdds/dds/xtypes/dynamic_types/DynamicTypeBuilderFactory.hpp>
#include <fastdds/dds/xtypes/dynamic_types/MemberDescriptor.hpp>
#include <fastdds/dds/xtypes/dynamic_types/TypeDescriptor.hpp>
#include <fastdds/dds/xtypes/type_representation/ITypeObjectRegistry.hpp>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>

namespace rmw_fastrtps {

namespace {

using Type = fdds::traits<fdds::DynamicType>::ref_type;
using Builder = fdds::traits<fdds::DynamicTypeBuilder>::ref_type;

constexpr auto kUnbounded = static_cast<std::uint32_t>(fdds::LENGTH_UNLIMITED);

Type struct_of(const rosidl_type_description_t& description);

Type made_by(const Builder& builder) {
  Type type = builder == nullptr ? nullptr : builder->build();
  if (type == nullptr) {
    throw std::runtime_error("Fast DDS cannot describe the members of a message");
  }
  return type;
}

fdds::TypeKind kind_of(const rosidl_field_description_t& field) {
  switch (field.type_id % kManyFactor) {
    case kInt8:
      return fdds::TK_INT8;
    case kUint8:
    case kByte:
      return fdds::TK_UINT8;
    case kInt16:
      return fdds::TK_INT16;
    case kUint16:
      return fdds::TK_UINT16;
    case kInt32:
      return fdds::TK_INT32;
    case kUint32:
      return fdds::TK_UINT32;
    case kInt64:
      return fdds::TK_INT64;
    case kUint64:
      return fdds::TK_UINT64;
    case kFloat:
      return fdds::TK_FLOAT32;
    case kDouble:
      return fdds::TK_FLOAT64;
    case kBoolean:
      return fdds::TK_BOOLEAN;
    default:
      throw std::runtime_error(std::string("messages with a field such as '") + field.name +
                               "' cannot be filtered by content");
  }
}

Type element_of(const rosidl_field_description_t& field) {
  const auto factory = fdds::DynamicTypeBuilderFactory::get_instance();
  switch (field.type_id % kManyFactor) {
    case kNested:
      return struct_of(*field.nested_type);
    case kString:
    case kBoundedString:
      return made_by(factory->create_string_type(kUnbounded));
    case kWstring:
    case kBoundedWstring:
      return made_by(factory->create_wstring_type(kUnbounded));
    default:
      return factory->get_primitive_type(kind_of(field));
  }
}

Type type_of(const rosidl_field_description_t& field) {
  const auto factory = fdds::DynamicTypeBuilderFactory::get_instance();
  const Type element = element_of(field);
  switch (field.type_id / kManyFactor) {
    case kOne:
      return element;
    case kArray:
      return made_by(factory->create_array_type(element, {static_cast<std::uint32_t>(field.capacity)}));
    case kBoundedSequence:
      return made_by(factory->create_sequence_type(element, static_cast<std::uint32_t>(field.capacity)));
    default:
      return made_by(factory->create_sequence_type(element, kUnbounded));
  }
}

Type struct_of(const rosidl_type_description_t& description) {
  auto structure = fdds::traits<fdds::TypeDescriptor>::make_shared();
  structure->kind(fdds::TK_STRUCTURE);
  structure->name(dds_name(description.type_name));
  // Plain CDR: members one after the other.
  structure->extensibility_kind(fdds::ExtensibilityKind::FINAL);
  const Builder builder = fdds::DynamicTypeBuilderFactory::get_instance()->create_type(structure);
  for (std::size_t i = 0; builder != nullptr && i < description.field_count; ++i) {
    auto member = fdds::traits<fdds::MemberDescriptor>::make_shared();
    member->name(description.fields[i].name);
    member->id(static_cast<fdds::MemberId>(i));
    member->type(type_of(description.fields[i]));
    if (builder->add_member(member) != return_code::kOk) {
      throw std::runtime_error("Fast DDS cannot describe type '" + dds_name(description.type_name) + "'");
    }
  }
  return made_by(builder);
}

}  // namespace

// Filters find the type by its name. It is not told to the type of the topic, so endpoints announce nothing of it.
void register_type_object(const rosidl_type_description_t& description) {
  static std::mutex mutex;
  static std::set<std::string> registered;
  const std::lock_guard lock(mutex);
  const std::string name = dds_name(description.type_name);
  if (registered.count(name) != 0) {
    return;
  }
  namespace xtypes = fdds::xtypes;
  xtypes::TypeIdentifierPair identifiers;
  auto& registry = fdds::DomainParticipantFactory::get_instance()->type_object_registry();
  bool is_known = registry.register_typeobject_w_dynamic_type(struct_of(description), identifiers) == return_code::kOk;
  // That registers the type without its name.
  const bool first_is_complete = identifiers.type_identifier1()._d() == xtypes::EK_COMPLETE;
  xtypes::TypeObject object;
  is_known = is_known && registry.get_type_object(
                             first_is_complete ? identifiers.type_identifier1() : identifiers.type_identifier2(),
                             object) == return_code::kOk;
  if (!is_known || registry.register_type_object(name, object.complete(), identifiers) != return_code::kOk) {
    throw std::runtime_error("Fast DDS cannot describe type '" + name + "'");
  }
  registered.insert(name);
}

}  // namespace rmw_fastrtps

#endif
