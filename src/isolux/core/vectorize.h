#pragma once

/// Before a function whose loops run over plain arrays: compiles it once for each width of vector
/// units; which version runs is decided at start. All give the same bits, since nothing is
/// contracted into fused operations (-ffp-contract=off) and sums keep their order.
///
/// Thread sanitizers can't stand the choice at start.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define ISOLUX_VECTORIZE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ISOLUX_VECTORIZE
#endif
