# SPDX-License-Identifier: Apache-2.0
# TEST_CORPUS: the folder of the launch files of other projects, unpacked with their licences from the archive that the
# conformance tests hold. Tests and benchmarks read them.
set(TEST_CORPUS ${PROJECT_BINARY_DIR}/corpus)
set(corpus_archive ${PROJECT_SOURCE_DIR}/tests/conformance/corpus.tar.xz)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${corpus_archive})
if(${corpus_archive} IS_NEWER_THAN ${TEST_CORPUS}/README.md)
  file(REMOVE_RECURSE ${TEST_CORPUS})
  file(ARCHIVE_EXTRACT INPUT ${corpus_archive} DESTINATION ${TEST_CORPUS} TOUCH)
endif()
