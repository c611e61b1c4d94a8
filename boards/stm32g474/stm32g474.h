/// The registers of the STM32G474 that this port uses, by the names of RM0440.
///
/// Purpose     Addresses, offsets and bits in one place, each checked at compile time where the
///             compiler can. Registers between those used are `unused`.
/// Tests       With STM32G474_FAKE every peripheral is memory that the test provides, and the
///             instructions of the Cortex-M4 are left out on other processors.
#ifndef SERVOID_STM32G474_H
#define SERVOID_STM32G474_H

#include "servoid/sid_fixed.h"

#include <stddef.h>

#ifdef STM32G474_FAKE
void* stm32g474_fake(uint32_t address);
#define STM32G474_AT(address) stm32g474_fake(address)
#else
#define STM32G474_AT(address) ((void*)(address))
#endif

typedef volatile uint32_t reg_t;

#define OFFSET(type, member, offset)                                                               \
    SID_STATIC_ASSERT(offsetof(type, member) == (offset), type##_##member)

/// value in a field that begins at bit `at`.
#define FIELD(value, at) ((uint32_t)(value) << (at))
#define BIT(at) ((uint32_t)1 << (at))

/// Waits for the hardware, a bounded time; false if it did not come.
bool stm32g474_wait(const reg_t* at, uint32_t mask, uint32_t value);
/// At least so long at 170 MHz, ten times that on the 16 MHz of the reset.
void stm32g474_delay_us(uint32_t us);

// ---------------------------------------------------------------- memory

#define SRAMCAN_BASE 0x4000A400U

// ---------------------------------------------------------------- RCC, PWR, FLASH

typedef struct {
    reg_t CR;
    uint32_t unused_04;
    reg_t CFGR;
    reg_t PLLCFGR;
    uint32_t unused_10[15];
    reg_t AHB2ENR;
    uint32_t unused_50[2];
    reg_t APB1ENR1;
    uint32_t unused_5C;
    reg_t APB2ENR;
    uint32_t unused_64[9];
    reg_t CCIPR;
} rcc_t;
OFFSET(rcc_t, PLLCFGR, 0x0C);
OFFSET(rcc_t, AHB2ENR, 0x4C);
OFFSET(rcc_t, APB1ENR1, 0x58);
OFFSET(rcc_t, APB2ENR, 0x60);
OFFSET(rcc_t, CCIPR, 0x88);
#define RCC ((rcc_t*)STM32G474_AT(0x40021000U))

#define RCC_CR_HSEON BIT(16)
#define RCC_CR_HSERDY BIT(17)
#define RCC_CR_CSSON BIT(19)
#define RCC_CR_PLLON BIT(24)
#define RCC_CR_PLLRDY BIT(25)
#define RCC_CFGR_SW 3U
#define RCC_CFGR_SW_PLL 3U
#define RCC_CFGR_SWS FIELD(3, 2)
#define RCC_CFGR_SWS_PLL FIELD(3, 2)
#define RCC_CFGR_HPRE FIELD(15, 4)
#define RCC_CFGR_HPRE_DIV2 FIELD(8, 4)
#define RCC_PLLCFGR_PLLSRC_HSE 3U
#define RCC_PLLCFGR_PLLM_AT 4U
#define RCC_PLLCFGR_PLLN_AT 8U
#define RCC_PLLCFGR_PLLREN BIT(24)
#define RCC_PLLCFGR_PLLR_AT 25U
#define RCC_AHB2ENR_GPIOAEN BIT(0)
#define RCC_AHB2ENR_GPIOBEN BIT(1)
#define RCC_AHB2ENR_GPIOCEN BIT(2)
#define RCC_AHB2ENR_ADC12EN BIT(13)
#define RCC_APB1ENR1_TIM2EN BIT(0)
#define RCC_APB1ENR1_FDCANEN BIT(25)
#define RCC_APB1ENR1_PWREN BIT(28)
#define RCC_APB2ENR_SYSCFGEN BIT(0)
#define RCC_APB2ENR_TIM1EN BIT(11)
#define RCC_CCIPR_FDCANSEL_PCLK1 FIELD(2, 24)

typedef struct {
    reg_t CR1;
    uint32_t unused_04[4];
    reg_t SR2;
    uint32_t unused_18[26];
    reg_t CR5;
} pwr_t;
OFFSET(pwr_t, SR2, 0x14);
OFFSET(pwr_t, CR5, 0x80);
#define PWR ((pwr_t*)STM32G474_AT(0x40007000U))

#define PWR_SR2_VOSF BIT(10)
#define PWR_CR5_R1MODE BIT(8)

typedef struct {
    reg_t ACR;
} flash_t;
#define FLASH ((flash_t*)STM32G474_AT(0x40022000U))

#define FLASH_ACR_LATENCY 15U
#define FLASH_ACR_PRFTEN BIT(8)
#define FLASH_ACR_ICEN BIT(9)
#define FLASH_ACR_DCEN BIT(10)

// ---------------------------------------------------------------- GPIO, SYSCFG

typedef struct {
    reg_t MODER;
    reg_t OTYPER;
    reg_t OSPEEDR;
    reg_t PUPDR;
    uint32_t unused_10[4];
    reg_t AFR[2];
} gpio_t;
OFFSET(gpio_t, PUPDR, 0x0C);
OFFSET(gpio_t, AFR, 0x20);
#define GPIOA ((gpio_t*)STM32G474_AT(0x48000000U))
#define GPIOB ((gpio_t*)STM32G474_AT(0x48000400U))
#define GPIOC ((gpio_t*)STM32G474_AT(0x48000800U))

#define GPIO_MODER_ALTERNATE 2U
#define GPIO_MODER_ANALOG 3U
#define GPIO_PUPDR_DOWN 2U
#define GPIO_PUPDR_UP 1U

typedef struct {
    uint32_t unused_00[7];
    reg_t CFGR2;
} syscfg_t;
OFFSET(syscfg_t, CFGR2, 0x1C);
#define SYSCFG ((syscfg_t*)STM32G474_AT(0x40010000U))

#define SYSCFG_CFGR2_CLL BIT(0)

// ---------------------------------------------------------------- TIM1, TIM2

typedef struct {
    reg_t CR1;
    reg_t CR2;
    reg_t SMCR;
    uint32_t unused_0C;
    reg_t SR;
    reg_t EGR;
    reg_t CCMR1;
    uint32_t unused_1C;
    reg_t CCER;
    reg_t CNT;
    reg_t PSC;
    reg_t ARR;
    reg_t RCR;
    reg_t CCR1;
    reg_t CCR2;
    uint32_t unused_3C[2];
    reg_t BDTR;
    uint32_t unused_48[6];
    reg_t AF1;
} tim_t;
OFFSET(tim_t, SR, 0x10);
OFFSET(tim_t, CCMR1, 0x18);
OFFSET(tim_t, CCER, 0x20);
OFFSET(tim_t, ARR, 0x2C);
OFFSET(tim_t, CCR2, 0x38);
OFFSET(tim_t, BDTR, 0x44);
OFFSET(tim_t, AF1, 0x60);
#define TIM1 ((tim_t*)STM32G474_AT(0x40012C00U))
#define TIM2 ((tim_t*)STM32G474_AT(0x40000000U))

#define TIM_CR1_CEN BIT(0)
#define TIM_CR1_CMS_CENTER FIELD(1, 5)
#define TIM_CR1_ARPE BIT(7)
#define TIM_CR2_MMS2_UPDATE FIELD(2, 20)
#define TIM_SMCR_SMS_ENCODER_BOTH 3U
#define TIM_SR_BIF BIT(7)
#define TIM_SR_SBIF BIT(13)
#define TIM_EGR_UG BIT(0)
#define TIM_CCMR1_OC1PE BIT(3)
#define TIM_CCMR1_OC1M_PWM1 FIELD(6, 4)
#define TIM_CCMR1_OC2PE BIT(11)
#define TIM_CCMR1_OC2M_PWM1 FIELD(6, 12)
#define TIM_CCMR1_CC1S_TI1 FIELD(1, 0)
#define TIM_CCMR1_IC1F_AT 4U
#define TIM_CCMR1_CC2S_TI2 FIELD(1, 8)
#define TIM_CCMR1_IC2F_AT 12U
#define TIM_CCER_CC1E BIT(0)
#define TIM_CCER_CC1NE BIT(2)
#define TIM_CCER_CC2E BIT(4)
#define TIM_CCER_CC2NE BIT(6)
#define TIM_BDTR_DTG_AT 0U
#define TIM_BDTR_LOCK_1 FIELD(1, 8)
#define TIM_BDTR_OSSI BIT(10)
#define TIM_BDTR_OSSR BIT(11)
#define TIM_BDTR_BKE BIT(12)
#define TIM_BDTR_MOE BIT(15)
#define TIM_BDTR_BKF_AT 16U
#define TIM_AF1_BKINE BIT(0)

// ---------------------------------------------------------------- ADC1, ADC2

typedef struct {
    reg_t ISR;
    reg_t IER;
    reg_t CR;
    reg_t CFGR;
    uint32_t unused_10;
    reg_t SMPR1;
    uint32_t unused_18[13];
    reg_t JSQR;
    uint32_t unused_50[12];
    reg_t JDR1;
} adc_t;
OFFSET(adc_t, SMPR1, 0x14);
OFFSET(adc_t, JSQR, 0x4C);
OFFSET(adc_t, JDR1, 0x80);
#define ADC1 ((adc_t*)STM32G474_AT(0x50000000U))
#define ADC2 ((adc_t*)STM32G474_AT(0x50000100U))

#define ADC_ISR_ADRDY BIT(0)
#define ADC_ISR_JEOC BIT(5)
#define ADC_ISR_JEOS BIT(6)
#define ADC_IER_JEOSIE BIT(6)
#define ADC_CR_ADEN BIT(0)
#define ADC_CR_JADSTART BIT(3)
#define ADC_CR_ADVREGEN BIT(28)
#define ADC_CR_ADCAL BIT(31)
#define ADC_CFGR_JQDIS BIT(31)
#define ADC_JSQR_JEXTSEL_TIM1_TRGO2 FIELD(8, 2)
#define ADC_JSQR_JEXTEN_RISING FIELD(1, 7)
#define ADC_JSQR_JSQ1_AT 9U

typedef struct {
    uint32_t unused_00[2];
    reg_t CCR;
} adc_common_t;
OFFSET(adc_common_t, CCR, 0x08);
#define ADC12_COMMON ((adc_common_t*)STM32G474_AT(0x50000300U))

#define ADC_CCR_CKMODE_HCLK_DIV4 FIELD(3, 16)

// ---------------------------------------------------------------- FDCAN1

typedef struct {
    uint32_t unused_00[3];
    reg_t DBTP;
    uint32_t unused_10[2];
    reg_t CCCR;
    reg_t NBTP;
    uint32_t unused_20[9];
    reg_t PSR;
    reg_t TDCR;
    uint32_t unused_4C[13];
    reg_t RXGFC;
    uint32_t unused_84[3];
    reg_t RXF0S;
    reg_t RXF0A;
    uint32_t unused_98[10];
    reg_t TXBC;
    reg_t TXFQS;
    uint32_t unused_C8;
    reg_t TXBAR;
} fdcan_t;
OFFSET(fdcan_t, DBTP, 0x0C);
OFFSET(fdcan_t, CCCR, 0x18);
OFFSET(fdcan_t, PSR, 0x44);
OFFSET(fdcan_t, TDCR, 0x48);
OFFSET(fdcan_t, RXGFC, 0x80);
OFFSET(fdcan_t, RXF0S, 0x90);
OFFSET(fdcan_t, TXBC, 0xC0);
OFFSET(fdcan_t, TXFQS, 0xC4);
OFFSET(fdcan_t, TXBAR, 0xCC);
#define FDCAN1 ((fdcan_t*)STM32G474_AT(0x40006400U))

#define FDCAN_CCCR_INIT BIT(0)
#define FDCAN_CCCR_CCE BIT(1)
#define FDCAN_CCCR_FDOE BIT(8)
#define FDCAN_CCCR_BRSE BIT(9)
#define FDCAN_NBTP_NTSEG2_AT 0U
#define FDCAN_NBTP_NTSEG1_AT 8U
#define FDCAN_NBTP_NSJW_AT 25U
#define FDCAN_DBTP_DSJW_AT 0U
#define FDCAN_DBTP_DTSEG2_AT 4U
#define FDCAN_DBTP_DTSEG1_AT 8U
#define FDCAN_DBTP_TDC BIT(23)
#define FDCAN_TDCR_TDCO_AT 8U
#define FDCAN_RXGFC_RRFE BIT(0)
#define FDCAN_RXGFC_RRFS BIT(1)
#define FDCAN_RXGFC_ANFE_REJECT FIELD(2, 2)
#define FDCAN_RXGFC_ANFS_REJECT FIELD(2, 4)
#define FDCAN_RXGFC_LSS_AT 16U
#define FDCAN_RXF0S_F0FL 15U
#define FDCAN_RXF0S_F0GI_AT 8U
#define FDCAN_TXFQS_TFQPI_AT 16U
#define FDCAN_TXFQS_TFQF BIT(21)

/// Message RAM of FDCAN1: words from SRAMCAN_BASE on.
#define FDCAN_RAM_WORDS 212U
#define FDCAN_RAM_FILTERS 0U
#define FDCAN_RAM_RX_FIFO_0 44U
#define FDCAN_RAM_TX_FIFO 158U
#define FDCAN_ELEMENT_WORDS 18U
/// Word 0 and 1 of an element of Rx FIFO and Tx FIFO.
#define FDCAN_ELEMENT_ID_AT 18U
#define FDCAN_ELEMENT_FDF BIT(21)
#define FDCAN_ELEMENT_BRS BIT(20)
#define FDCAN_ELEMENT_DLC_AT 16U
/// A filter for standard identifiers.
#define FDCAN_FILTER_RANGE FIELD(0, 30)
#define FDCAN_FILTER_DUAL FIELD(1, 30)
#define FDCAN_FILTER_TO_FIFO_0 FIELD(1, 27)
#define FDCAN_FILTER_ID1_AT 16U

// ---------------------------------------------------------------- IWDG, DBGMCU

typedef struct {
    reg_t KR;
    reg_t PR;
    reg_t RLR;
    reg_t SR;
} iwdg_t;
OFFSET(iwdg_t, SR, 0x0C);
#define IWDG ((iwdg_t*)STM32G474_AT(0x40003000U))

#define IWDG_KR_START 0xCCCCU
#define IWDG_KR_ACCESS 0x5555U
#define IWDG_KR_RELOAD 0xAAAAU
#define IWDG_PR_DIV32 3U

typedef struct {
    uint32_t unused_00[2];
    reg_t APB1FZR1;
    uint32_t unused_0C;
    reg_t APB2FZR;
} dbgmcu_t;
OFFSET(dbgmcu_t, APB1FZR1, 0x08);
OFFSET(dbgmcu_t, APB2FZR, 0x10);
#define DBGMCU ((dbgmcu_t*)STM32G474_AT(0xE0042000U))

#define DBGMCU_APB1FZR1_IWDG_STOP BIT(12)
#define DBGMCU_APB2FZR_TIM1_STOP BIT(11)

// ---------------------------------------------------------------- Cortex-M4

#define ADC1_2_IRQ 18U
#define NVIC_ISER0 ((reg_t*)STM32G474_AT(0xE000E100U))
/// Priorities, a byte an interrupt; the upper four bits count.
#define NVIC_IPR ((volatile uint8_t*)STM32G474_AT(0xE000E400U))
#define SCB_VTOR ((reg_t*)STM32G474_AT(0xE000ED08U))
#define SCB_AIRCR ((reg_t*)STM32G474_AT(0xE000ED0CU))
#define SCB_AIRCR_RESET (FIELD(0x5FA, 16) | BIT(2))
#define SCB_CPACR ((reg_t*)STM32G474_AT(0xE000ED88U))
#define SCB_CPACR_FPU FIELD(15, 20)
#define DCB_DEMCR ((reg_t*)STM32G474_AT(0xE000EDFCU))
#define DCB_DEMCR_TRCENA BIT(24)
#define DWT_CTRL ((reg_t*)STM32G474_AT(0xE0001000U))
#define DWT_CTRL_CYCCNTENA BIT(0)
#define DWT_CYCCNT ((reg_t*)STM32G474_AT(0xE0001004U))

#if defined(__arm__)
#define CORTEX_M4(instruction) __asm__ volatile(instruction ::: "memory")
static inline void cortex_m4_set_basepri(uint32_t priority) {
    __asm__ volatile("msr basepri, %0\n\tisb" ::"r"(priority) : "memory");
}
#else
#define CORTEX_M4(instruction) SID_FENCE()
static inline void cortex_m4_set_basepri(uint32_t priority) { (void)priority; }
#endif

#endif
