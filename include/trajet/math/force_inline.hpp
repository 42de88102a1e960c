#pragma once

/// Inlining that speed depends on: a law evaluated on a number type must melt into straight-line code.
#define TRAJET_INLINE __attribute__((always_inline)) inline
/// Inlines every call inside the function, a user's lambda included.
#define TRAJET_FLATTEN __attribute__((flatten))
