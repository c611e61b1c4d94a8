// What the port writes into the registers, read back by the addresses and bits of RM0440 as
// numbers, and computed on: clock, rate, bit timings, frames.
#include "board.h"
#include "clock.h"
#include "fake.h"
#include "fdcan.h"
#include "power_stage.h"

#include <string.h>

#define RCC 0x40021000U
#define PWR_CR5 0x40007080U
#define FLASH_ACR 0x40022000U
#define TIM1 0x40012C00U
#define TIM2 0x40000000U
#define ADC1 0x50000000U
#define ADC2 0x50000100U
#define FDCAN1 0x40006400U
#define RAM 0x4000A400U
#define IWDG 0x40003000U
#define GPIOA 0x48000000U
#define GPIOB 0x48000400U
#define GPIOC 0x48000800U
#define HSE_HZ 24000000U
#define NODE 1U

static void say(const char* name, int64_t value, const char* unit) {
    board_print(name);
    board_print_int(value);
    board_print(unit);
}

// ---------------------------------------------------------------- clock

static int looks_at_switch;

static void look_at_clock(uint32_t address) {
    if ((address == RCC + 8U) && (looks_at_switch++ == 0)) { // the switch to the PLL
        expect(fake_bits(PWR_CR5, 8, 8) == 0U, "boost before the switch", 0);
        expect(fake_bits(FLASH_ACR, 3, 0) == 4U, "wait states before the switch", 0);
        expect(fake_bits(RCC + 8U, 7, 4) == 8U, "half the speed at the switch", 0);
        expect(fake_bits(RCC, 25, 25) == 1U, "PLL ready before the switch", 0);
    }
}

static void test_clock(void) {
    fake_reset();
    fake_on_wait = look_at_clock;
    expect(clock_init(), "clock", 0);
    const uint32_t m = fake_bits(RCC + 0x0CU, 7, 4) + 1U;
    const uint32_t n = fake_bits(RCC + 0x0CU, 14, 8);
    const uint32_t r = 2U * (fake_bits(RCC + 0x0CU, 26, 25) + 1U);
    const uint32_t vco_Hz = HSE_HZ / m * n;
    expect(fake_bits(RCC + 0x0CU, 1, 0) == 3U, "PLL from HSE", 0);
    expect(fake_bits(RCC + 0x0CU, 24, 24) == 1U, "PLL R on", 0);
    expect((HSE_HZ / m >= 2660000U) && (HSE_HZ / m <= 16000000U), "PLL input, Hz", HSE_HZ / m);
    expect((vco_Hz >= 96000000U) && (vco_Hz <= 344000000U), "VCO, Hz", vco_Hz);
    expect(vco_Hz / r == 170000000U, "core, Hz", vco_Hz / r);
    expect(fake_bits(RCC + 8U, 3, 0) == 15U, "core on PLL", fake_get(RCC + 8U));
    expect(fake_bits(RCC + 8U, 13, 4) == 0U, "buses at full speed", fake_get(RCC + 8U));
    expect(fake_bits(FLASH_ACR, 10, 8) == 7U, "prefetch and caches", fake_get(FLASH_ACR));
    expect(fake_bits(RCC, 19, 19) == 1U, "clock security system", 0);
    expect(looks_at_switch == 2, "steps to full speed", looks_at_switch);
    say("core ", vco_Hz / r, " Hz, ");
    say("", fake_bits(FLASH_ACR, 3, 0), " wait states\n");
    fake_reset();
    fake_dead_address = RCC; // no crystal
    expect(!clock_init(), "clock without crystal", 0);
    expect(fake_bits(RCC + 8U, 1, 0) == 1U, "stays on HSI", 0);
}

static void test_watchdog(void) {
    fake_reset();
    expect(watchdog_init(), "watchdog", 0);
    const uint32_t us =
        (fake_bits(IWDG + 8U, 11, 0) + 1U) * (4U << fake_bits(IWDG + 4U, 2, 0)) * 1000U / 32U;
    expect(us == 250000U, "watchdog, us", us);
    expect(fake_get(IWDG) == 0xAAAAU, "watchdog fed", fake_get(IWDG));
}

// ---------------------------------------------------------------- power stage

static void expect_pin(uint32_t port, uint32_t pin, uint32_t alternate, const char* what) {
    const uint32_t mode = fake_bits(port, 2U * pin + 1U, 2U * pin);
    const uint32_t at = pin % 8U * 4U;
    expect(mode == 2U, what, mode);
    expect(fake_bits(port + 0x20U + pin / 8U * 4U, at + 3U, at) == alternate, what, pin);
}

static void look_at_adc(uint32_t address) {
    const uint32_t cr = address - address % 0x100U + 8U;
    if ((address == ADC1 + 8U) || (address == ADC2 + 8U)) {
        expect(fake_get(cr) == 0x90000000U, "calibrates with the regulator on, disabled", address);
    } else if ((address == ADC1) || (address == ADC2)) {
        expect(fake_get(cr) == 0x10000001U, "enabled after the calibration", address);
    } else {
        // another
    }
}

static void test_adc(uint32_t adc, uint32_t channel) {
    expect(fake_bits(adc + 0x4CU, 1, 0) == 0U, "one conversion", adc);
    expect(fake_bits(adc + 0x4CU, 6, 2) == 8U, "trigger is TIM1_TRGO2", adc);
    expect(fake_bits(adc + 0x4CU, 8, 7) == 1U, "at the rising edge", adc);
    expect(fake_bits(adc + 0x4CU, 13, 9) == channel, "channel", adc);
    expect(fake_bits(adc + 0x14U, 3U * channel + 2U, 3U * channel) == 3U, "24.5 cycles", adc);
    expect(fake_get(adc + 8U) == 0x10000009U, "waits for triggers", adc);
}

static void test_timing(void) {
    const uint32_t turns = fake_get(TIM1 + 0x2CU);
    const uint32_t repetitions = fake_get(TIM1 + 0x30U) + 1U;
    const uint32_t period_cycles = (fake_get(TIM1 + 0x28U) + 1U) * turns * repetitions;
    expect(170000000U % period_cycles == 0U, "cycles of a control period", period_cycles);
    expect(170000000U / period_cycles == 8000U, "control interrupts, Hz",
           170000000U / period_cycles);
    expect(fake_bits(TIM1, 6, 5) != 0U, "counts up and down", 0);
    expect(repetitions % 2U == 0U, "updates at one kind of turn", repetitions);
    expect(fake_bits(TIM1 + 4U, 23, 20) == 2U, "TRGO2 is the update", 0);
    expect(fake_get(TIM1 + 0x14U) == 1U, "repetition counter loaded before the start", 0);
    say("PWM ", 170000000U / (2U * turns), " Hz, ");
    say("control interrupt ", 170000000U / period_cycles, " Hz, ");
    say("dead time ", fake_bits(TIM1 + 0x44U, 7, 0) * 1000 / 170, " ns\n");
}

static void test_outputs(void) {
    const uint32_t bdtr = TIM1 + 0x44U;
    expect(fake_get(TIM1 + 0x18U) == 0x6868U, "PWM mode 1, preloaded", fake_get(TIM1 + 0x18U));
    expect(fake_get(TIM1 + 0x20U) == 0x55U, "CH1, CH1N, CH2, CH2N", fake_get(TIM1 + 0x20U));
    expect(fake_bits(bdtr, 15, 14) == 0U, "MOE and AOE off after the start", fake_get(bdtr));
    expect(fake_bits(bdtr, 13, 10) == 7U, "break on, active low; OSSR, OSSI", fake_get(bdtr));
    expect(fake_bits(bdtr, 9, 8) == 1U, "break and dead time locked", fake_get(bdtr));
    expect(fake_bits(bdtr, 7, 0) == 85U, "dead time", fake_get(bdtr));
    expect(fake_get(TIM1 + 0x60U) == 1U, "break from BKIN", fake_get(TIM1 + 0x60U));
    power_stage_on();
    expect(fake_bits(bdtr, 15, 15) == 1U, "MOE on", 0);
    power_stage_off();
    expect(fake_bits(bdtr, 15, 15) == 0U, "MOE off", 0);
    fake_set(TIM1 + 0x10U, 0x80U);
    expect(power_stage_is_broken(), "break seen", 0);
    power_stage_forgive_break();
    expect(!power_stage_is_broken(), "break forgiven", 0);
    fake_set(TIM1 + 0x10U, 0x2000U);
    expect(power_stage_is_broken(), "system break seen", 0);
}

static void test_voltage(void) {
    for (int32_t v = -40000; v <= 40000; v += 100) {
        power_stage_set_voltage(v);
        const int32_t difference =
            (int32_t)fake_get(TIM1 + 0x34U) - (int32_t)fake_get(TIM1 + 0x38U);
        const int32_t held = (v > 30720) ? 30720 : ((v < -30720) ? -30720 : v);
        const int32_t error_q15 = difference * 32768 / 2125 - held;
        expect((error_q15 >= -17) && (error_q15 <= 17), "voltage, Q15", v);
    }
}

static void test_power_stage(void) {
    fake_reset();
    fake_on_wait = look_at_adc;
    expect(power_stage_init(), "power stage", 0);
    expect(fake_bits(TIM1, 0, 0) == 0U, "TIM1 stands before the start", 0);
    expect(fake_get(0xE000E100U) == 0U, "no interrupt before the start", 0);
    test_outputs();
    power_stage_start();
    expect(fake_bits(TIM1, 0, 0) == 1U, "TIM1 runs", 0);
    expect(fake_get(0xE000E100U) == (uint32_t)1 << 18, "interrupt 18", fake_get(0xE000E100U));
    expect(fake_bits(0xE000E410U, 23, 16) == 0x10U, "its priority", fake_get(0xE000E410U));
    test_timing();
    test_voltage();
    test_adc(ADC1, 6);
    test_adc(ADC2, 7);
    expect(fake_get(ADC1 + 4U) == 0x40U, "interrupt at the end of ADC1's sequence", 0);
    expect(fake_get(ADC2 + 4U) == 0U, "and of no other", 0);
    expect(fake_bits(0x50000308U, 17, 16) == 3U, "converters at 42.5 MHz", 0);
    expect_pin(GPIOA, 8, 6, "TIM1_CH1");
    expect_pin(GPIOB, 13, 6, "TIM1_CH1N");
    expect_pin(GPIOA, 9, 6, "TIM1_CH2");
    expect_pin(GPIOB, 14, 6, "TIM1_CH2N");
    expect_pin(GPIOB, 12, 6, "TIM1_BKIN");
    expect(fake_bits(GPIOB + 0x0CU, 25, 24) == 2U, "BKIN pulled down", 0);
    expect_pin(GPIOA, 0, 1, "TIM2_CH1");
    expect_pin(GPIOA, 1, 1, "TIM2_CH2");
    expect(fake_bits(GPIOC, 3, 0) == 15U, "PC0 and PC1 analog", 0);
    expect(fake_bits(GPIOA, 27, 26) == 2U, "the debugger's pins stay", fake_get(GPIOA));
    expect(fake_bits(TIM2 + 8U, 2, 0) == 3U, "encoder, both edges of both tracks", 0);
    expect(fake_get(TIM2 + 0x2CU) == UINT32_MAX, "encoder, all 32 bits", 0);
    expect((fake_get(TIM2 + 0x18U) & 0x303U) == 0x101U, "encoder, inputs", 0);
    expect(fake_get(TIM2) == 1U, "encoder counts", 0);
    expect(fake_bits(RCC + 0x4CU, 13, 13) && fake_bits(RCC + 0x58U, 0, 0) &&
               fake_bits(RCC + 0x60U, 11, 11),
           "clocks of ADC12, TIM2 and TIM1", 0);
    fake_reset();
    fake_dead_address = ADC2;
    expect(!power_stage_init(), "power stage without ADC2", 0);
}

// ---------------------------------------------------------------- CAN

static void test_bit(const char* name, uint32_t prescaler, uint32_t seg1, uint32_t seg2,
                     uint32_t rate) {
    const uint32_t quanta = 1U + seg1 + seg2;
    const uint32_t sample_point_ppm = (1U + seg1) * 1000000U / quanta;
    expect(170000000U % (prescaler * quanta) == 0U, name, quanta);
    expect(170000000U / (prescaler * quanta) == rate, name, rate);
    expect((sample_point_ppm >= 750000U) && (sample_point_ppm <= 875000U), name, sample_point_ppm);
    say(name, rate, " bit/s, ");
    say("sample point ", sample_point_ppm / 1000U, " per mille\n");
}

static void look_at_can(uint32_t address) {
    expect((address == FDCAN1 + 0x18U) && (fake_get(address) == 1U), "INIT alone at first",
           fake_get(address));
}

// RM0440 44.3.11: the elements in their order, first match; what matches none is refused.
static bool is_let_in(uint32_t id) {
    for (uint32_t i = 0; i < fake_bits(FDCAN1 + 0x80U, 20, 16); i++) {
        const uint32_t element = RAM + 4U * i;
        const uint32_t id1 = fake_bits(element, 26, 16);
        const uint32_t id2 = fake_bits(element, 10, 0);
        const uint32_t type = fake_bits(element, 31, 30);
        const bool is_match = (type == 0U)   ? (id >= id1) && (id <= id2)
                              : (type == 1U) ? (id == id1) || (id == id2)
                                             : false;
        if (is_match) {
            return fake_bits(element, 29, 27) == 1U;
        }
    }
    return fake_bits(FDCAN1 + 0x80U, 5, 4) == 0U;
}

static void test_filters(void) {
    for (uint32_t id = 0; id < 0x800U; id++) {
        const bool is_ours = (id == 0U) || (id == 0x500U + NODE) || (id == 0x600U + NODE) ||
                             ((id > 0x700U) && (id < 0x780U));
        expect(is_let_in(id) == is_ours, "filter", id);
    }
    expect(fake_bits(FDCAN1 + 0x80U, 3, 0) == 11U, "extended and remote frames refused", 0);
}

static void test_can_init(void) {
    fake_reset();
    fake_set(RAM + 4U * 211U, 0x12345678U);
    fake_on_wait = look_at_can;
    expect(fdcan_init(NODE), "FDCAN", 0);
    fake_on_wait = 0;
    const uint32_t nbtp = FDCAN1 + 0x1CU;
    const uint32_t dbtp = FDCAN1 + 0x0CU;
    test_bit("nominal ", fake_bits(nbtp, 24, 16) + 1U, fake_bits(nbtp, 15, 8) + 1U,
             fake_bits(nbtp, 6, 0) + 1U, 1000000U);
    test_bit("data ", fake_bits(dbtp, 20, 16) + 1U, fake_bits(dbtp, 12, 8) + 1U,
             fake_bits(dbtp, 7, 4) + 1U, 5000000U);
    expect(fake_bits(nbtp, 31, 25) <= fake_bits(nbtp, 6, 0), "nominal jump width", 0);
    expect(fake_bits(dbtp, 3, 0) <= fake_bits(dbtp, 7, 4), "data jump width", 0);
    expect(fake_bits(dbtp, 23, 23) == 1U, "delay compensation", 0);
    expect(fake_bits(FDCAN1 + 0x48U, 14, 8) == 2U + fake_bits(dbtp, 12, 8), "its offset", 0);
    expect(fake_get(FDCAN1 + 0x18U) == 0x300U, "FD, bit rate switch, started",
           fake_get(FDCAN1 + 0x18U));
    expect(fake_get(FDCAN1 + 0xC0U) == 0U, "Tx FIFO", 0);
    expect(fake_bits(RCC + 0x88U, 25, 24) == 2U, "clock is PCLK1", 0);
    expect(fake_bits(RCC + 0x58U, 25, 25) == 1U, "clock of FDCAN", 0);
    expect(fake_get(RAM + 4U * 211U) == 0U, "message RAM cleared", 0);
    expect_pin(GPIOA, 11, 9, "FDCAN1_RX");
    expect_pin(GPIOA, 12, 9, "FDCAN1_TX");
    test_filters();
}

static sid_can_frame_t frame_of(uint32_t id, uint32_t length, bool fd) {
    sid_can_frame_t frame;
    memset(&frame, 0xEE, sizeof(frame));
    frame.id = id;
    frame.length = (uint8_t)length;
    frame.fd = fd;
    for (uint32_t i = 0; i < length; i++) {
        frame.data[i] = (uint8_t)(0x51U * i + id);
    }
    return frame;
}

static bool is_same(const sid_can_frame_t* a, const sid_can_frame_t* b, uint32_t length) {
    return (a->id == b->id) && (a->fd == b->fd) && (b->length == length) &&
           (memcmp(a->data, b->data, a->length) == 0);
}

// Out by the port and in by the port, with the tables of RM0440 in between.
static int test_frame(uint32_t id, uint32_t length, uint32_t sent_length, bool fd) {
    uint32_t element[FAKE_ELEMENT];
    uint32_t expected[FAKE_ELEMENT];
    sid_can_frame_t there;
    sid_can_frame_t back;
    const sid_can_frame_t frame = frame_of(id, length, fd);
    expect(fdcan_send(&frame), "sent", length);
    expect(fake_can_leave(element), "left", length);
    fake_decode(element, &there);
    expect(is_same(&frame, &there, sent_length), "as sent", length);
    fake_encode(&there, expected);
    expect(memcmp(element, expected, (2U + (sent_length + 3U) / 4U) * 4U) == 0, "element", length);
    for (uint32_t i = length; i < sent_length; i++) {
        expect(there.data[i] == 0U, "padded by zeros", length);
    }
    element[0] |= 0x80000000U; // what a receiver adds: ESI, filter index, time stamp
    element[1] |= 0x0200BEEFU;
    expect(fake_can_arrive(element), "arrived", length);
    expect(fdcan_receive(&back), "received", length);
    expect(is_same(&there, &back, sent_length), "as received", length);
    return 1;
}

static void test_frames(void) {
    static const uint8_t lengths[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
    int count = 0;
    for (uint32_t dlc = 0; dlc < 16U; dlc++) {
        count += test_frame(0x481U + dlc, lengths[dlc], lengths[dlc], true);
    }
    for (uint32_t length = 0; length <= 8U; length++) {
        count += test_frame(0x7FFU - length, length, length, false);
    }
    count += test_frame(0, 9, 12, true) + test_frame(1, 33, 48, true);
    uint32_t element[FAKE_ELEMENT] = {0x581U << 18, 15U << 16};
    sid_can_frame_t back;
    expect(fake_can_arrive(element) && fdcan_receive(&back), "classic with DLC 15", 0);
    expect(!back.fd && (back.length == 8U), "has 8 bytes", back.length);
    say("frames there and back: ", count, "\n");
}

static void test_fifos(void) {
    uint32_t element[FAKE_ELEMENT];
    sid_can_frame_t frame;
    for (uint32_t i = 0; i < 3U; i++) {
        frame = frame_of(0x100U + i, 8, false);
        expect(fdcan_send(&frame), "room for three", i);
    }
    frame = frame_of(0x103, 64, true);
    expect(!fdcan_send(&frame), "no room for a fourth", 0);
    for (uint32_t i = 0; i < 3U; i++) {
        sid_can_frame_t left;
        expect(fake_can_leave(element), "the three leave", i);
        fake_decode(element, &left);
        expect((left.id == 0x100U + i) && (left.length == 8U), "in order, untouched", left.id);
    }
    expect(!fake_can_leave(element), "and nothing else", 0);
    for (uint32_t i = 0; i < 3U; i++) {
        frame = frame_of(0x601U + i, 8, false);
        fake_encode(&frame, element);
        expect(fake_can_arrive(element), "three wait", i);
    }
    for (uint32_t i = 0; i < 3U; i++) {
        expect(fdcan_receive(&frame) && (frame.id == 0x601U + i), "in order", frame.id);
    }
    expect(!fdcan_receive(&frame), "empty", 0);
    fake_set(FDCAN1 + 0x18U, 0x301U); // bus off
    expect(!fdcan_receive(&frame) && (fake_get(FDCAN1 + 0x18U) == 0x300U), "back from bus off", 0);
}

int main(void) {
    test_clock();
    test_watchdog();
    test_power_stage();
    test_can_init();
    test_frames();
    test_fifos();
    return (fake_failures == 0) ? 0 : 1;
}
