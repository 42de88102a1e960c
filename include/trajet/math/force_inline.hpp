#pragma once

// Sanitizers multiply the code that is inlined until compilers choke on it; without speed to win, they go without.
#if defined(__SANITIZE_ADDRESS__)
#define TRAJET_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TRAJET_SANITIZED
#endif
#endif

#ifdef TRAJET_SANITIZED
#define TRAJET_INLINE inline
#define TRAJET_FLATTEN
#else
/// Inlining that speed depends on: a law evaluated on a number type must melt into straight-line code.
#define TRAJET_INLINE __attribute__((always_inline)) inline
/// Inlines every call inside the function, a user's lambda included.
#define TRAJET_FLATTEN __attribute__((flatten))
#endif
