#pragma once

/// Inlining that speed depends on: a law evaluated on a number type must melt into straight-line code.
#define TRAJET_INLINE __attribute__((always_inline)) inline
/// Inlines every call inside the function, a user's lambda included.
#define TRAJET_FLATTEN __attribute__((flatten))

/// Unrolls the next loop completely where its bounds are known at compile time.
#if defined(__clang__)
#define TRAJET_UNROLL _Pragma("clang loop unroll(full)")
#else
#define TRAJET_UNROLL _Pragma("GCC unroll 65534")
#endif
