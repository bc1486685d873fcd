# SPDX-License-Identifier: Apache-2.0
"""The packages of Debian and Ubuntu behind dependencies that are no packages of ROS.

A package.xml names such a dependency by a key, of which rosdep has a list. Most keys are the names of Debian's packages; the
others are here, as far as packages of ROS 2 name them. A key for a library alone means its development files, because packages
are built from their sources.
"""

import re
import subprocess
from pathlib import Path
from typing import Dict, Iterable, List, Mapping, Sequence, Set

from .package_xml import Package

# Keys that are names of Debian's packages as they are, besides those that look like it.
_SAME = re.compile(r'lib[a-z0-9.+-]*-dev|python3-[a-z0-9.+-]+')
_ALSO_SAME = frozenset((
    'acl', 'can-utils', 'clang', 'clang-tidy', 'cmake', 'cppcheck', 'doxygen', 'file', 'git', 'google-mock', 'graphviz',
    'geographiclib-tools', 'iproute2', 'iwyu', 'joystick', 'lcov', 'lm-sensors', 'lttng-tools', 'net-tools',
    'ocl-icd-opencl-dev', 'opencl-headers', 'pkg-config', 'portaudio19-dev', 'pybind11-dev', 'qt5-qmake', 'qtbase5-dev',
    'rapidjson-dev', 'spacenavd', 'unzip', 'v4l-utils', 'wget', 'xz-utils'))

_KEYS = '''
asio libasio-dev
assimp libassimp-dev
assimp-dev libassimp-dev
atlas libatlas-base-dev
benchmark libbenchmark-dev
boost libboost-all-dev
bullet libbullet-dev
bullet-extras libbullet-extras-dev
bzip2 libbz2-dev
cli11 libcli11-dev
cppunit libcppunit-dev
crypto++ libcrypto++-dev
curl libcurl4-openssl-dev curl
cwiid libcwiid-dev
cwiid-dev libcwiid-dev
eigen libeigen3-dev
ffmpeg ffmpeg libavcodec-dev libavformat-dev libavutil-dev libswscale-dev
fmt libfmt-dev
geographiclib libgeographiclib-dev
glpk libglpk-dev
glut freeglut3-dev
graphicsmagick libgraphicsmagick++1-dev
gtest libgtest-dev
gtk2 libgtk2.0-dev
gtk3 libgtk-3-dev
hdf5 libhdf5-dev
libbluetooth libbluetooth-dev
libboost-date-time libboost-date-time-dev
libboost-filesystem libboost-filesystem-dev
libboost-python libboost-python-dev
libboost-random libboost-random-dev
libboost-thread libboost-thread-dev
libfcl libfcl-dev
libfftw3 libfftw3-dev
libgps libgps-dev
libjpeg libjpeg-dev
libjsoncpp libjsoncpp-dev
liblz4 liblz4-dev
libogg libogg-dev
libopencv-core libopencv-dev
libopencv-highgui libopencv-dev
libopencv-imgcodecs libopencv-dev
libopencv-imgproc libopencv-dev
libopencv-videoio libopencv-dev
libpcap libpcap0.8-dev
libpcl-all libpcl-dev
libpcl-all-dev libpcl-dev
libpcl-common libpcl-dev
libpcl-features libpcl-dev
libpcl-filters libpcl-dev
libpcl-io libpcl-dev
libpcl-segmentation libpcl-dev
libpcl-surface libpcl-dev
libqhull libqhull-dev
libqt5-concurrent qtbase5-dev
libqt5-core qtbase5-dev
libqt5-gui qtbase5-dev
libqt5-network qtbase5-dev
libqt5-opengl libqt5opengl5-dev
libqt5-opengl-dev libqt5opengl5-dev
libqt5-printsupport qtbase5-dev
libqt5-svg libqt5svg5-dev
libqt5-svg-dev libqt5svg5-dev
libqt5-widgets qtbase5-dev
libtheora libtheora-dev
libusb libusb-dev
libusb-1.0 libusb-1.0-0-dev
libusb-1.0-dev libusb-1.0-0-dev
libx11 libx11-dev
libxaw libxaw7-dev
libxext libxext-dev
libxml2 libxml2-dev
libxrandr libxrandr-dev
libyaml libyaml-dev
libzmq3-dev libzmq3-dev cppzmq-dev
log4cxx liblog4cxx-dev
lua5.2-dev liblua5.2-dev
msgpack libmsgpack-dev
nlohmann-json-dev nlohmann-json3-dev
opengl libgl1-mesa-dev libglu1-mesa-dev
portaudio portaudio19-dev
proj libproj-dev
protobuf libprotobuf-dev protobuf-compiler
protobuf-dev libprotobuf-dev protobuf-compiler libprotoc-dev
pugixml-dev libpugixml-dev
python3 python3-dev
python3-lark-parser python3-lark
python3-types-pyyaml python3-typeshed
range-v3 librange-v3-dev
sdl libsdl1.2-dev
sdl2 libsdl2-dev
sdl2-image libsdl2-image-dev
sdl-image libsdl-image1.2-dev
spdlog libspdlog-dev
suitesparse libsuitesparse-dev
tbb libtbb-dev
tinyxml libtinyxml-dev
tinyxml2 libtinyxml2-dev
uuid uuid-dev
yaml libyaml-dev
yaml-cpp libyaml-cpp-dev
zlib zlib1g-dev
zziplib libzzip-dev
'''
KEYS: Dict[str, List[str]] = {line.split()[0]: line.split()[1:] for line in _KEYS.strip().splitlines()}


def debian_packages(key: str) -> List[str]:
    """The packages of Debian that a key stands for; none if it is no key that is known."""
    if key in KEYS:
        return KEYS[key]
    return [key] if key in _ALSO_SAME or _SAME.fullmatch(key) else []


def missing_packages(order: Sequence[Package], workspace: Mapping[str, Package], prefixes: Iterable[Path],
                     tests: bool) -> Dict[str, List[str]]:
    """For each package with dependencies that are not installed, the packages of Debian that bring them.

    Nothing on a system without dpkg."""
    prefixes = list(prefixes)
    named: Dict[str, List[str]] = {}
    for package in order:
        keys = [*package.depends, *(package.test_depends if tests else ())]
        names = [name for key in keys if key not in workspace and not any((prefix / 'share' / key).is_dir() for prefix in prefixes)
                 for name in debian_packages(key)]
        if names:
            named[package.name] = sorted(set(names))
    installed = _installed({name for names in named.values() for name in names})
    if installed is None:
        return {}
    left = {package: [name for name in names if name not in installed] for package, names in named.items()}
    return {package: names for package, names in left.items() if names}


def _installed(names: Set[str]):  # type: ignore[no-untyped-def]
    """Those of these packages that are installed, or None if there is no dpkg."""
    if not names:
        return set()
    try:
        run = subprocess.run(['dpkg-query', '-W', '-f', '${Package} ${db:Status-Status}\\n', *sorted(names)],
                             stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False)
    except OSError:
        return None
    return {line.split()[0] for line in run.stdout.splitlines() if line.endswith(' installed')}
