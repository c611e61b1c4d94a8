#include "clock.h"

#include "stm32g474.h"

#define FLASH_WAIT_STATES 4U // up to 170 MHz in range 1 boost
#define LSI_HZ 32000U
#define IWDG_DIVIDER 32U

SID_STATIC_ASSERT(CLOCK_HZ == 170000000U, pll_gives_170_MHz);

static bool switch_to_pll(void) {
    RCC->CFGR = (RCC->CFGR & ~(RCC_CFGR_SW | RCC_CFGR_HPRE)) | RCC_CFGR_SW_PLL | RCC_CFGR_HPRE_DIV2;
    return stm32g474_wait(&RCC->CFGR, RCC_CFGR_SWS, RCC_CFGR_SWS_PLL);
}

static bool start_pll(void) {
    RCC->CR |= RCC_CR_HSEON;
    if (!stm32g474_wait(&RCC->CR, RCC_CR_HSERDY, RCC_CR_HSERDY)) {
        return false;
    }
    RCC->PLLCFGR = RCC_PLLCFGR_PLLSRC_HSE | FIELD(CLOCK_PLLM - 1U, RCC_PLLCFGR_PLLM_AT) |
                   FIELD(CLOCK_PLLN, RCC_PLLCFGR_PLLN_AT) |
                   FIELD(CLOCK_PLLR / 2U - 1U, RCC_PLLCFGR_PLLR_AT) | RCC_PLLCFGR_PLLREN;
    RCC->CR |= RCC_CR_PLLON;
    return stm32g474_wait(&RCC->CR, RCC_CR_PLLRDY, RCC_CR_PLLRDY);
}

// RM0440 6.1.5: boost, wait states, half the speed for at least a microsecond, then all of it.
static bool raise_frequency(void) {
    PWR->CR5 &= ~PWR_CR5_R1MODE;
    FLASH->ACR = FLASH_WAIT_STATES | FLASH_ACR_PRFTEN | FLASH_ACR_ICEN | FLASH_ACR_DCEN;
    if (!stm32g474_wait(&PWR->SR2, PWR_SR2_VOSF, 0U) ||
        !stm32g474_wait(&FLASH->ACR, FLASH_ACR_LATENCY, FLASH_WAIT_STATES) || !switch_to_pll()) {
        return false;
    }
    stm32g474_delay_us(2);
    RCC->CFGR &= ~RCC_CFGR_HPRE;
    return stm32g474_wait(&RCC->CFGR, RCC_CFGR_HPRE, 0U);
}

bool clock_init(void) {
    RCC->APB1ENR1 |= RCC_APB1ENR1_PWREN;
    CORTEX_M4("dsb"); // a peripheral listens two cycles after its clock is on
    if (!start_pll() || !raise_frequency()) {
        return false;
    }
    RCC->CR |= RCC_CR_CSSON; // a crystal that stops: break of TIM1, and NMI
    return true;
}

bool watchdog_init(void) {
    DBGMCU->APB1FZR1 |= DBGMCU_APB1FZR1_IWDG_STOP;
    IWDG->KR = IWDG_KR_START;
    IWDG->KR = IWDG_KR_ACCESS;
    IWDG->PR = IWDG_PR_DIV32;
    IWDG->RLR = WATCHDOG_MS * (LSI_HZ / IWDG_DIVIDER) / 1000U - 1U;
    if (!stm32g474_wait(&IWDG->SR, 7U, 0U)) {
        return false;
    }
    watchdog_kick();
    return true;
}

void watchdog_kick(void) { IWDG->KR = IWDG_KR_RELOAD; }
