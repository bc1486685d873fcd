// SPDX-License-Identifier: Apache-2.0
// The type supports of C messages, for example ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String). The header of the
// interface must be included, too.
#pragma once

#include "rosidl_typesupport_interface/macros.h"

#define ROSIDL_GET_MSG_TYPE_SUPPORT(PkgName, MsgSubfolder, MsgName) \
  ROSIDL_TYPESUPPORT_INTERFACE__MESSAGE_SYMBOL_NAME(rosidl_typesupport_c, PkgName, MsgSubfolder, MsgName)()

#define ROSIDL_GET_SRV_TYPE_SUPPORT(PkgName, SrvSubfolder, SrvName) \
  ROSIDL_TYPESUPPORT_INTERFACE__SERVICE_SYMBOL_NAME(rosidl_typesupport_c, PkgName, SrvSubfolder, SrvName)()

#define ROSIDL_GET_ACTION_TYPE_SUPPORT(PkgName, Name) \
  ROSIDL_TYPESUPPORT_INTERFACE__ACTION_SYMBOL_NAME(rosidl_typesupport_c, PkgName, action, Name)()
