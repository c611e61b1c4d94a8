#include "power_stage.h"

#include "stm32g474.h"

#define AF_TIM1 6U
#define AF_TIM2 1U
#define ADC_CHANNEL_A 6U // PC0
#define ADC_CHANNEL_B 7U // PC1
#define SAMPLING_24_5_CYCLES 3U
#define BREAK_FILTER 3U   // 8 cycles of 170 MHz
#define ENCODER_FILTER 3U // the same
#define BREAKS (TIM_SR_BIF | TIM_SR_SBIF)

SID_STATIC_ASSERT(POWER_STAGE_CYCLES* POWER_STAGE_RATE_HZ == 170000000U, exactly_8_kHz);
SID_STATIC_ASSERT(POWER_STAGE_HALF_PERIODS % 2U == 0U, trigger_at_one_kind_of_turn);
SID_STATIC_ASSERT(POWER_STAGE_DEAD_TIME_CYCLES <= 127U, dead_time_fits_its_coding);

static void set_pin(gpio_t* port, uint32_t pin, uint32_t alternate, uint32_t pull) {
    port->AFR[pin / 8U] =
        (port->AFR[pin / 8U] & ~FIELD(15, pin % 8U * 4U)) | FIELD(alternate, pin % 8U * 4U);
    port->PUPDR = (port->PUPDR & ~FIELD(3, pin * 2U)) | FIELD(pull, pin * 2U);
    port->MODER = (port->MODER & ~FIELD(3, pin * 2U)) | FIELD(GPIO_MODER_ALTERNATE, pin * 2U);
}

// PORT: the pins. Outputs are pulled down, so that nothing conducts while TIM1 does not drive them.
static void init_pins(void) {
    RCC->AHB2ENR |= RCC_AHB2ENR_GPIOAEN | RCC_AHB2ENR_GPIOBEN | RCC_AHB2ENR_GPIOCEN;
    CORTEX_M4("dsb");
    set_pin(GPIOA, 8, AF_TIM1, GPIO_PUPDR_DOWN);  // CH1
    set_pin(GPIOB, 13, AF_TIM1, GPIO_PUPDR_DOWN); // CH1N
    set_pin(GPIOA, 9, AF_TIM1, GPIO_PUPDR_DOWN);  // CH2
    set_pin(GPIOB, 14, AF_TIM1, GPIO_PUPDR_DOWN); // CH2N
    set_pin(GPIOB, 12, AF_TIM1, GPIO_PUPDR_DOWN); // BKIN, active low: a broken wire is a fault
    set_pin(GPIOA, 0, AF_TIM2, GPIO_PUPDR_UP);    // encoder A
    set_pin(GPIOA, 1, AF_TIM2, GPIO_PUPDR_UP);    // encoder B
    GPIOC->MODER |= FIELD(GPIO_MODER_ANALOG, 0) | FIELD(GPIO_MODER_ANALOG, 2);
}

static void init_encoder(void) {
    RCC->APB1ENR1 |= RCC_APB1ENR1_TIM2EN;
    CORTEX_M4("dsb");
    TIM2->ARR = UINT32_MAX;
    TIM2->CCMR1 = TIM_CCMR1_CC1S_TI1 | TIM_CCMR1_CC2S_TI2 |
                  FIELD(ENCODER_FILTER, TIM_CCMR1_IC1F_AT) |
                  FIELD(ENCODER_FILTER, TIM_CCMR1_IC2F_AT);
    TIM2->SMCR = TIM_SMCR_SMS_ENCODER_BOTH;
    TIM2->CR1 = TIM_CR1_CEN;
}

// The repetition counter is loaded before the counter starts: updates then come at lower turns,
// where both legs are high and the motor's current flows in a circle.
static void init_pwm(void) {
    RCC->APB2ENR |= RCC_APB2ENR_TIM1EN | RCC_APB2ENR_SYSCFGEN;
    CORTEX_M4("dsb");
    SYSCFG->CFGR2 |= SYSCFG_CFGR2_CLL;
    DBGMCU->APB2FZR |= DBGMCU_APB2FZR_TIM1_STOP;
    TIM1->CR1 = TIM_CR1_CMS_CENTER | TIM_CR1_ARPE;
    TIM1->CR2 = TIM_CR2_MMS2_UPDATE;
    TIM1->PSC = 0;
    TIM1->ARR = POWER_STAGE_ARR;
    TIM1->RCR = POWER_STAGE_HALF_PERIODS - 1U;
    TIM1->CCMR1 = TIM_CCMR1_OC1M_PWM1 | TIM_CCMR1_OC1PE | TIM_CCMR1_OC2M_PWM1 | TIM_CCMR1_OC2PE;
    TIM1->CCER = TIM_CCER_CC1E | TIM_CCER_CC1NE | TIM_CCER_CC2E | TIM_CCER_CC2NE;
    power_stage_set_voltage(0);
    TIM1->AF1 = TIM_AF1_BKINE;
    TIM1->BDTR = FIELD(POWER_STAGE_DEAD_TIME_CYCLES, TIM_BDTR_DTG_AT) | TIM_BDTR_OSSI |
                 TIM_BDTR_OSSR | TIM_BDTR_BKE | FIELD(BREAK_FILTER, TIM_BDTR_BKF_AT) |
                 TIM_BDTR_LOCK_1; // until the next reset nobody changes dead time and break
    TIM1->EGR = TIM_EGR_UG;
}

// RM0440 21.4.6, 21.4.8 and 21.4.9: regulator, calibration, on.
static bool enable_adc(adc_t* adc) {
    adc->CR = 0; // leaves deep power down
    adc->CR = ADC_CR_ADVREGEN;
    stm32g474_delay_us(20);
    adc->CR = ADC_CR_ADVREGEN | ADC_CR_ADCAL;
    if (!stm32g474_wait(&adc->CR, ADC_CR_ADCAL, 0U)) {
        return false;
    }
    stm32g474_delay_us(1); // four cycles of the converter
    adc->ISR = ADC_ISR_ADRDY;
    adc->CR = ADC_CR_ADVREGEN | ADC_CR_ADEN;
    return stm32g474_wait(&adc->ISR, ADC_ISR_ADRDY, ADC_ISR_ADRDY);
}

// One injected conversion a trigger, 0.9 us; the queue of contexts is off.
static void set_channel(adc_t* adc, uint32_t channel) {
    adc->CFGR = ADC_CFGR_JQDIS;
    adc->SMPR1 = FIELD(SAMPLING_24_5_CYCLES, channel * 3U);
    adc->JSQR =
        ADC_JSQR_JEXTSEL_TIM1_TRGO2 | ADC_JSQR_JEXTEN_RISING | FIELD(channel, ADC_JSQR_JSQ1_AT);
}

static bool init_adcs(void) {
    RCC->AHB2ENR |= RCC_AHB2ENR_ADC12EN;
    CORTEX_M4("dsb");
    ADC12_COMMON->CCR = ADC_CCR_CKMODE_HCLK_DIV4; // 42.5 MHz, in step with TIM1
    if (!enable_adc(ADC1) || !enable_adc(ADC2)) {
        return false;
    }
    set_channel(ADC1, ADC_CHANNEL_A);
    set_channel(ADC2, ADC_CHANNEL_B);
    ADC1->IER = ADC_IER_JEOSIE; // both end in the same cycle
    return true;
}

bool power_stage_init(void) {
    init_pwm();
    init_pins();
    init_encoder();
    return init_adcs();
}

void power_stage_start(void) {
    NVIC_IPR[ADC1_2_IRQ] = POWER_STAGE_IRQ_PRIORITY;
    *NVIC_ISER0 = BIT(ADC1_2_IRQ);
    ADC2->CR = ADC_CR_ADVREGEN | ADC_CR_ADEN | ADC_CR_JADSTART;
    ADC1->CR = ADC_CR_ADVREGEN | ADC_CR_ADEN | ADC_CR_JADSTART;
    TIM1->CR1 |= TIM_CR1_CEN;
}

void power_stage_on(void) { TIM1->BDTR |= TIM_BDTR_MOE; }
void power_stage_off(void) { TIM1->BDTR &= ~TIM_BDTR_MOE; }
bool power_stage_is_broken(void) { return (TIM1->SR & BREAKS) != 0U; }
void power_stage_forgive_break(void) { TIM1->SR = ~BREAKS; } // a 1 changes nothing

void power_stage_set_voltage(int32_t voltage_q15) {
    const int32_t v =
        sid_clamp(voltage_q15, -POWER_STAGE_MOST_VOLTAGE_Q15, POWER_STAGE_MOST_VOLTAGE_Q15);
    TIM1->CCR1 = (POWER_STAGE_ARR * (uint32_t)(32768 + v) + 32768U) >> 16;
    TIM1->CCR2 = (POWER_STAGE_ARR * (uint32_t)(32768 - v) + 32768U) >> 16;
}

power_stage_sample_t power_stage_read(void) {
    power_stage_sample_t sample;
    ADC1->ISR = ADC_ISR_JEOC | ADC_ISR_JEOS;
    sample.current_a = (int32_t)ADC1->JDR1;
    sample.current_b = (int32_t)ADC2->JDR1;
    return sample;
}

uint32_t power_stage_encoder(void) { return TIM2->CNT; }
