#pragma once

/// Put before a function: compiles its body for plain x86-64 and for vectors of four and eight
/// doubles. The program chooses at its start what the processor can do.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define MENISCUS_VECTOR_CLONES \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define MENISCUS_VECTOR_CLONES
#endif

/// A function that is compiled into each clone of its caller.
#define MENISCUS_INLINE [[gnu::always_inline]] inline
