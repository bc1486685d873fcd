# SPDX-License-Identifier: Apache-2.0
"""The base classes of messages, services and actions, and their metaclasses, with the names of ROS 2 Lyrical.

They are for `isinstance` and for annotations: what the classes do is in those that rosidl_generator_py makes.
"""

from abc import ABC, ABCMeta
from typing import Any, ClassVar, Dict, Generic, Type, TypeVar


class MessageTypeSupportMeta(ABCMeta):
    """The capsules that rclpy uses; None until the type support is imported."""

    _CREATE_ROS_MESSAGE: ClassVar[Any] = None
    _CONVERT_FROM_PY: ClassVar[Any] = None
    _CONVERT_TO_PY: ClassVar[Any] = None
    _DESTROY_ROS_MESSAGE: ClassVar[Any] = None
    _TYPE_SUPPORT: ClassVar[Any] = None

    @classmethod
    def __import_type_support__(cls) -> None:
        """Fills the capsules. Raises ImportError if there is no library for the type."""


class ServiceTypeSupportMeta(ABCMeta):
    """The capsule of a service."""

    _TYPE_SUPPORT: ClassVar[Any] = None

    @classmethod
    def __import_type_support__(cls) -> None:
        """Fills the capsules of the service and of its messages."""


class ActionTypeSupportMeta(ABCMeta):
    """The capsule of an action."""

    _TYPE_SUPPORT: ClassVar[Any] = None

    @classmethod
    def __import_type_support__(cls) -> None:
        """Fills the capsules of the action, of its services and of their messages."""


class BaseMessage(ABC, metaclass=MessageTypeSupportMeta):
    """Any message."""

    __slots__ = ()

    @classmethod
    def get_fields_and_field_types(cls) -> Dict[str, str]:
        """The types of the fields by their names."""
        raise NotImplementedError


RequestT = TypeVar('RequestT')
ResponseT = TypeVar('ResponseT')


class BaseService(ABC, Generic[RequestT, ResponseT], metaclass=ServiceTypeSupportMeta):
    """Any service."""

    Request: Type[RequestT]
    Response: Type[ResponseT]


SendGoalServiceT = TypeVar('SendGoalServiceT')
GetResultServiceT = TypeVar('GetResultServiceT')
FeedbackMessageT = TypeVar('FeedbackMessageT')


class BaseImpl(ABC, Generic[SendGoalServiceT, GetResultServiceT, FeedbackMessageT]):
    """The services and messages that carry an action."""

    SendGoalService: Type[SendGoalServiceT]
    GetResultService: Type[GetResultServiceT]
    FeedbackMessage: Type[FeedbackMessageT]
    CancelGoalService: Type[Any]
    GoalStatusMessage: Type[Any]


GoalT = TypeVar('GoalT')
ResultT = TypeVar('ResultT')
FeedbackT = TypeVar('FeedbackT')
ImplT = TypeVar('ImplT', bound=BaseImpl[Any, Any, Any])


class BaseAction(ABC, Generic[GoalT, ResultT, FeedbackT, ImplT], metaclass=ActionTypeSupportMeta):
    """Any action."""

    Goal: Type[GoalT]
    Result: Type[ResultT]
    Feedback: Type[FeedbackT]
    Impl: Type[ImplT]
