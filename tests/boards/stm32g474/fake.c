#include "fake.h"

#include "board.h"
#include "stm32g474.h"

#include <string.h>

#define BLOCK 1024U
#define BLOCKS 40U
#define FDCAN1_AT 0x40006400U
#define RXF0S_AT (FDCAN1_AT + 0x90U)
#define RXF0A_AT (FDCAN1_AT + 0x94U)
#define TXFQS_AT (FDCAN1_AT + 0xC4U)
#define TXBAR_AT (FDCAN1_AT + 0xCCU)
#define RX_AT (0x4000A400U + 0xB0U)
#define TX_AT (0x4000A400U + 0x278U)
#define NOT_WRITTEN 0xFFFFFFFFU

static struct {
    uint32_t at;
    uint32_t words[BLOCK / 4U];
} blocks[BLOCKS];
static uint32_t used;

static uint32_t rx_get, rx_fill, tx_get, tx_fill;

void (*fake_on_wait)(uint32_t address);
uint32_t fake_dead_address;
int fake_failures;

// ---------------------------------------------------------------- memory

static uint32_t* word(uint32_t address) {
    uint32_t i = 0;
    while ((i < used) && (blocks[i].at != address / BLOCK)) {
        i++;
    }
    if (i == used) {
        if (used == BLOCKS) {
            board_exit(9);
        }
        blocks[used++].at = address / BLOCK;
    }
    return &blocks[i].words[address % BLOCK / 4U];
}

uint32_t fake_get(uint32_t address) { return *word(address); }
void fake_set(uint32_t address, uint32_t value) { *word(address) = value; }
uint32_t fake_bits(uint32_t address, uint32_t high, uint32_t low) {
    return (uint32_t)(((uint64_t)fake_get(address) >> low) & (((uint64_t)2 << (high - low)) - 1U));
}

// ---------------------------------------------------------------- what the FDCAN does by itself

static void update_can(void) {
    if (fake_get(RXF0A_AT) != NOT_WRITTEN) {
        expect(fake_get(RXF0A_AT) == rx_get, "acknowledged what was not the oldest",
               fake_get(RXF0A_AT));
        rx_get = (fake_get(RXF0A_AT) + 1U) % 3U;
        rx_fill--;
        fake_set(RXF0A_AT, NOT_WRITTEN);
    }
    if (fake_get(TXBAR_AT) != 0U) {
        expect(fake_get(TXBAR_AT) == (uint32_t)1 << ((tx_get + tx_fill) % 3U),
               "requested another buffer than the next", fake_get(TXBAR_AT));
        tx_fill++;
        fake_set(TXBAR_AT, 0);
    }
    fake_set(RXF0S_AT, rx_fill | (rx_get << 8) | (((rx_get + rx_fill) % 3U) << 16) |
                           ((rx_fill == 3U) ? (uint32_t)1 << 24 : 0U));
    fake_set(TXFQS_AT, (3U - tx_fill) | (tx_get << 8) | (((tx_get + tx_fill) % 3U) << 16) |
                           ((tx_fill == 3U) ? (uint32_t)1 << 21 : 0U));
}

void* stm32g474_fake(uint32_t address) {
    if (address == FDCAN1_AT) {
        update_can();
    }
    return word(address);
}

bool fake_can_arrive(const uint32_t element[FAKE_ELEMENT]) {
    update_can();
    if (rx_fill == 3U) {
        return false;
    }
    for (uint32_t i = 0; i < FAKE_ELEMENT; i++) {
        fake_set(RX_AT + ((rx_get + rx_fill) % 3U * FAKE_ELEMENT + i) * 4U, element[i]);
    }
    rx_fill++;
    update_can();
    return true;
}

bool fake_can_leave(uint32_t element[FAKE_ELEMENT]) {
    update_can();
    if (tx_fill == 0U) {
        return false;
    }
    for (uint32_t i = 0; i < FAKE_ELEMENT; i++) {
        element[i] = fake_get(TX_AT + (tx_get * FAKE_ELEMENT + i) * 4U);
    }
    tx_get = (tx_get + 1U) % 3U;
    tx_fill--;
    update_can();
    return true;
}

static const uint8_t bytes_of_dlc[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};

void fake_encode(const sid_can_frame_t* frame, uint32_t element[FAKE_ELEMENT]) {
    uint32_t dlc = 0;
    while (bytes_of_dlc[dlc] != frame->length) {
        dlc++;
    }
    memset(element, 0, FAKE_ELEMENT * 4U);
    element[0] = frame->id * 0x40000U;
    element[1] = dlc * 0x10000U + (frame->fd ? 0x300000U : 0U);
    for (uint32_t i = 0; i < frame->length; i++) {
        element[2U + i / 4U] |= (uint32_t)frame->data[i] << (8U * (i % 4U));
    }
}

void fake_decode(const uint32_t element[FAKE_ELEMENT], sid_can_frame_t* frame) {
    memset(frame, 0, sizeof(*frame));
    frame->id = element[0] / 0x40000U;
    frame->fd = (element[1] & 0x200000U) != 0U;
    frame->length = bytes_of_dlc[element[1] / 0x10000U % 16U];
    for (uint32_t i = 0; i < frame->length; i++) {
        frame->data[i] = (uint8_t)(element[2U + i / 4U] >> (8U * (i % 4U)));
    }
}

// ---------------------------------------------------------------- waiting

static uint32_t address_of(const reg_t* at) {
    for (uint32_t i = 0; i < used; i++) {
        if ((at >= blocks[i].words) && (at < blocks[i].words + BLOCK / 4U)) {
            return blocks[i].at * BLOCK + (uint32_t)(at - blocks[i].words) * 4U;
        }
    }
    return 0;
}

bool stm32g474_wait(const reg_t* at, uint32_t mask, uint32_t value) {
    const uint32_t address = address_of(at);
    if (fake_on_wait != 0) {
        fake_on_wait(address);
    }
    if (address == fake_dead_address) {
        return false;
    }
    fake_set(address, (fake_get(address) & ~mask) | value);
    return true;
}

void stm32g474_delay_us(uint32_t us) { (void)us; }

// ---------------------------------------------------------------- reset, and what was found

void fake_reset(void) {
    memset(blocks, 0, sizeof(blocks));
    used = 0;
    rx_get = rx_fill = tx_get = tx_fill = 0;
    fake_on_wait = 0;
    fake_dead_address = 0;
    fake_set(0x40021000U, 0x00000063U); // RCC_CR
    fake_set(0x40021008U, 0x00000005U); // RCC_CFGR
    fake_set(0x4002100CU, 0x00001000U); // RCC_PLLCFGR
    fake_set(0x40007080U, 0x00000100U); // PWR_CR5
    fake_set(0x40022000U, 0x00040601U); // FLASH_ACR
    fake_set(0x48000000U, 0xABFFFFFFU); // GPIOA_MODER
    fake_set(0x48000400U, 0xFFFFFEBFU); // GPIOB_MODER
    fake_set(0x48000800U, 0xFFFFFFFFU); // GPIOC_MODER
    fake_set(0x50000008U, 0x20000000U); // ADC1_CR: deep power down
    fake_set(0x50000108U, 0x20000000U);
    fake_set(RXF0A_AT, NOT_WRITTEN);
    update_can();
}

void expect(bool is_so, const char* what, int64_t value) {
    if (!is_so) {
        fake_failures++;
        board_print("not so: ");
        board_print(what);
        board_print(": ");
        board_print_int(value);
        board_print("\n");
    }
}
