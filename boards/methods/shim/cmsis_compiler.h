// What CMSIS-DSP asks of CMSIS-Core's compiler header, for GCC on a Cortex-M: attributes, and the
// intrinsics of the Arm C Language Extensions. Only where CMSIS-Core itself is not at hand.
#ifndef SERVOID_SHIM_CMSIS_COMPILER_H
#define SERVOID_SHIM_CMSIS_COMPILER_H

#include <arm_acle.h>
#include <stdint.h>

#define __ASM __asm__
#define __INLINE inline
#define __STATIC_INLINE static inline
#define __STATIC_FORCEINLINE static inline __attribute__((always_inline))
#define __ALIGNED(bytes) __attribute__((aligned(bytes)))
#define __WEAK __attribute__((weak))
#define __PACKED __attribute__((packed))

#define __SSAT(x, bits) __ssat((x), (bits))
#define __USAT(x, bits) __usat((x), (bits))
#define __ROR(x, n) __ror((x), (n))
#define __QADD(a, b) __qadd((a), (b))
#define __QSUB(a, b) __qsub((a), (b))
#define __QADD16(a, b) ((uint32_t)__qadd16((int16x2_t)(a), (int16x2_t)(b)))
#define __QSUB16(a, b) ((uint32_t)__qsub16((int16x2_t)(a), (int16x2_t)(b)))
#define __QADD8(a, b) ((uint32_t)__qadd8((int8x4_t)(a), (int8x4_t)(b)))
#define __QSUB8(a, b) ((uint32_t)__qsub8((int8x4_t)(a), (int8x4_t)(b)))
#define __SMMLA(a, b, c) __smmla((a), (b), (c))
#define __PKHBT(low, high, n) (((uint32_t)(low)&0xFFFFU) | ((uint32_t)(high) << (n)&0xFFFF0000U))

__STATIC_FORCEINLINE uint8_t __CLZ(uint32_t x) {
    return (x == 0U) ? 32U : (uint8_t)__builtin_clz(x);
}

#endif
