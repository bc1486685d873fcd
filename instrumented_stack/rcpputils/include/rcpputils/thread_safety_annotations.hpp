// SPDX-License-Identifier: Apache-2.0
// Clang's annotations of which mutex guards what. They are empty with other compilers.
#pragma once

#if defined(__clang__)
#define RCPPUTILS_THREAD_ANNOTATION_ATTRIBUTE_IMPL(annotation) __attribute__((annotation))
#else
#define RCPPUTILS_THREAD_ANNOTATION_ATTRIBUTE_IMPL(annotation)
#endif

#define RCPPUTILS_TSA_CAPABILITY(name) RCPPUTILS_THREAD_ANNOTATION_ATTRIBUTE_IMPL(capability(name))
#define RCPPUTILS_TSA_SCOPED_CAPABILITY RCPPUTILS_THREAD_ANNOTATION_ATTRIBUTE_IMPL(scoped_lockable)
#define RCPPUTILS_TSA_GUARDED_BY(mutex) RCPPUTILS_THREAD_ANNOTATION_ATTRIBUTE_IMPL(guarded_by(mutex))
#define RCPPUTILS_TSA_PT_GUARDED_BY(mutex) RCPPUTILS_THREAD_ANNOTATION_ATTRIBUTE_IMPL(pt_guarded_by(mutex))
#define RCPPUTILS_TSA_REQUIRES(...) RCPPUTILS_THREAD_ANNOTATION_ATTRIBUTE_IMPL(requires_capability(__VA_ARGS__))
#define RCPPUTILS_TSA_ACQUIRE(...) RCPPUTILS_THREAD_ANNOTATION_ATTRIBUTE_IMPL(acquire_capability(__VA_ARGS__))
#define RCPPUTILS_TSA_RELEASE(...) RCPPUTILS_THREAD_ANNOTATION_ATTRIBUTE_IMPL(release_capability(__VA_ARGS__))
#define RCPPUTILS_TSA_EXCLUDES(...) RCPPUTILS_THREAD_ANNOTATION_ATTRIBUTE_IMPL(locks_excluded(__VA_ARGS__))
