# SPDX-License-Identifier: Apache-2.0
"""What tests of messages in Python share: objects with values, and the bytes that the middleware makes of a message."""

import ctypes
import os
import random
from importlib import import_module
from pathlib import Path

from rosidl_parser import definition

LIBRARIES = Path(os.environ['BUILD_DIRECTORY'], 'prefix/lib')
WORDS = ('', 'a', 'wörter', 'two words', 'ハロー', 'x' * 40)


def packages():
    """The packages of the stack that have modules in Python."""
    return os.environ['INTERFACE_PACKAGES'].split(',')


def classes_of(package):
    """All classes of messages, also those of the parts of services and actions."""
    for namespace in ('msg', 'srv', 'action'):
        try:
            module = import_module(f'{package}.{namespace}')
        except ModuleNotFoundError as error:
            if error.name != f'{package}.{namespace}':
                raise
            continue
        for name in module.__all__:
            class_ = getattr(module, name)
            if hasattr(class_, 'SLOT_TYPES'):
                yield class_


class Values:
    """Values of all types. The same seed gives the same values."""

    def __init__(self, seed):
        self._random = random.Random(seed)

    def message(self, class_):
        fields = zip(class_.get_fields_and_field_types(), class_.SLOT_TYPES)
        return class_(check_fields=True, **{name: self.value(type_) for name, type_ in fields})

    def value(self, type_):
        if isinstance(type_, definition.Array):
            some = [self.value(type_.value_type) for _ in range(min(type_.size, 64))]
            return (some * (type_.size // len(some) + 1))[:type_.size]
        if isinstance(type_, definition.AbstractSequence):
            most = min(type_.maximum_size, 4) if type_.has_maximum_size() else 4
            return [self.value(type_.value_type) for _ in range(self._random.randint(0, most))]
        if isinstance(type_, definition.NamespacedType):
            *module, name = type_.namespaced_name()
            return self.message(getattr(import_module('.'.join(module)), name))
        if isinstance(type_, definition.AbstractGenericString):
            word = self._random.choice(WORDS)
            return word[:type_.maximum_size] if type_.has_maximum_size() else word
        return self._basic(type_.typename)

    def _basic(self, name):
        if name == 'boolean':
            return self._random.random() < 0.5
        if name == 'octet':
            return bytes([self._random.randrange(256)])
        if name == 'float':
            return self._random.randrange(-1 << 20, 1 << 20) / 1024  # a number that 32 bits hold
        if name == 'double':
            return self._random.choice((self._random.uniform(-1e300, 1e300), float('inf'), -0.0))
        bits = int(name.lstrip('uint'))
        low, high = (0, (1 << bits) - 1) if name.startswith('u') else (-(1 << (bits - 1)), (1 << (bits - 1)) - 1)
        return self._random.choice((low, high, self._random.randint(low, high)))


class _Allocator(ctypes.Structure):
    _fields_ = [(name, ctypes.c_void_p) for name in ('allocate', 'deallocate', 'reallocate', 'zero_allocate', 'state')]


class _Bytes(ctypes.Structure):
    _fields_ = [('buffer', ctypes.c_void_p), ('length', ctypes.c_size_t), ('capacity', ctypes.c_size_t), ('allocator', _Allocator)]


class _Callbacks(ctypes.Structure):
    _fields_ = [(name, ctypes.c_void_p) for name in ('namespace', 'name', 'hash', 'write', 'read', 'size', 'max_size', 'description',
                                                     'create', 'destroy')]


class _Handle(ctypes.Structure):
    _fields_ = [('identifier', ctypes.c_char_p), ('callbacks', ctypes.POINTER(_Callbacks)), ('function', ctypes.c_void_p)]


def _library(name):
    return ctypes.CDLL(str(LIBRARIES / f'lib{name}.so'))


_CREATE = ctypes.CFUNCTYPE(ctypes.c_void_p)
_DESTROY = ctypes.CFUNCTYPE(None, ctypes.c_void_p)
_FROM_PYTHON = ctypes.PYFUNCTYPE(ctypes.c_bool, ctypes.py_object, ctypes.c_void_p)
_TO_PYTHON = ctypes.PYFUNCTYPE(ctypes.py_object, ctypes.c_void_p)
_pointer = ctypes.pythonapi.PyCapsule_GetPointer
_pointer.restype = ctypes.c_void_p
_pointer.argtypes = [ctypes.py_object, ctypes.c_char_p]


def pointer(capsule):
    """What a capsule of a class holds. Their names are null, as rclpy expects."""
    return _pointer(capsule, None)


class Middleware:
    """Reads and writes messages by the handles of their types, as rclpy and rclcpp do."""

    # Enough for all messages of the tests.
    CAPACITY = 1 << 16

    def __init__(self):
        self._rmw = _library('rmw')
        self._rcutils = _library('rcutils')
        self._rcutils.rcutils_get_default_allocator.restype = _Allocator

    def write(self, handle, message):
        data = _Bytes()
        allocator = self._rcutils.rcutils_get_default_allocator()
        assert self._rcutils.rcutils_uint8_array_init(ctypes.byref(data), ctypes.c_size_t(self.CAPACITY), ctypes.byref(allocator)) == 0
        ctypes.memset(data.buffer, 0, self.CAPACITY)  # the bytes between values are not written
        assert self._rmw.rmw_serialize(ctypes.c_void_p(message), ctypes.c_void_p(handle), ctypes.byref(data)) == 0
        written = ctypes.string_at(data.buffer, data.length)
        self._rcutils.rcutils_uint8_array_fini(ctypes.byref(data))
        return written

    def read(self, handle, data, message):
        buffer = ctypes.create_string_buffer(data, len(data))
        given = _Bytes(ctypes.cast(buffer, ctypes.c_void_p), len(data), len(data), self._rcutils.rcutils_get_default_allocator())
        assert self._rmw.rmw_deserialize(ctypes.byref(given), ctypes.c_void_p(handle), ctypes.c_void_p(message)) == 0


class Conversion:
    """A class of messages by its capsules, as rclpy uses it."""

    def __init__(self, class_):
        if class_._TYPE_SUPPORT is None:
            class_.__import_type_support__()
        self._create = _CREATE(pointer(class_._CREATE_ROS_MESSAGE))
        self._destroy = _DESTROY(pointer(class_._DESTROY_ROS_MESSAGE))
        self._from_python = _FROM_PYTHON(pointer(class_._CONVERT_FROM_PY))
        self._to_python = _TO_PYTHON(pointer(class_._CONVERT_TO_PY))
        self._handle = pointer(class_._TYPE_SUPPORT)
        self._middleware = Middleware()

    def bytes_of(self, message):
        created = self._create()
        try:
            converted = self._from_python(message, created)
            assert converted
            return self._middleware.write(self._handle, created)
        finally:
            self._destroy(created)

    def message_of(self, data):
        created = self._create()
        try:
            self._middleware.read(self._handle, data, created)
            return self._to_python(created)
        finally:
            self._destroy(created)


class CppType:
    """The type of C++ of a class, found by the name that compilers give the function of its handle."""

    def __init__(self, class_):
        package, namespace, _ = class_.__module__.split('.')
        parts = ''.join(f'{len(part)}{part}' for part in (package, namespace, class_.__name__))
        function = getattr(_library(package), '_ZN22rosidl_typesupport_cpp31get_message_type_support_handleI'
                           f'N{parts}EEEPK29rosidl_message_type_support_tv')
        function.restype = ctypes.c_void_p
        self._handle = function()
        callbacks = ctypes.cast(self._handle, ctypes.POINTER(_Handle)).contents.callbacks.contents
        self._create = _CREATE(callbacks.create)
        self._destroy = _DESTROY(callbacks.destroy)
        self._middleware = Middleware()

    def bytes_of_new_message(self):
        return self._bytes_of(None)

    def bytes_after_reading(self, data):
        return self._bytes_of(data)

    def _bytes_of(self, data):
        message = self._create()
        try:
            if data is not None:
                self._middleware.read(self._handle, data, message)
            return self._middleware.write(self._handle, message)
        finally:
            self._destroy(message)
