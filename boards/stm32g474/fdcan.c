#include "fdcan.h"

#include "servoid/sid_node.h"
#include "stm32g474.h"

#define AF_FDCAN1 9U
#define RX_PIN 11U // PA11
#define TX_PIN 12U // PA12
#define FILTERS 3U

static const uint8_t length_of_dlc[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};

static reg_t* ram(uint32_t word) { return (reg_t*)STM32G474_AT(SRAMCAN_BASE) + word; }

// The smallest that holds so many bytes.
static uint32_t dlc_of_length(uint32_t length) {
    uint32_t dlc = 0;
    while ((dlc < 15U) && (length_of_dlc[dlc] < length)) {
        dlc++;
    }
    return dlc;
}

// ---------------------------------------------------------------- init

static void init_pins(void) { // PORT: the pins; the transceiver must be one for 5 Mbit/s
    RCC->AHB2ENR |= RCC_AHB2ENR_GPIOAEN;
    CORTEX_M4("dsb");
    GPIOA->AFR[1] =
        (GPIOA->AFR[1] & ~(FIELD(15, (RX_PIN - 8U) * 4U) | FIELD(15, (TX_PIN - 8U) * 4U))) |
        FIELD(AF_FDCAN1, (RX_PIN - 8U) * 4U) | FIELD(AF_FDCAN1, (TX_PIN - 8U) * 4U);
    GPIOA->MODER = (GPIOA->MODER & ~(FIELD(3, RX_PIN * 2U) | FIELD(3, TX_PIN * 2U))) |
                   FIELD(GPIO_MODER_ALTERNATE, RX_PIN * 2U) |
                   FIELD(GPIO_MODER_ALTERNATE, TX_PIN * 2U);
}

static void init_ram(uint32_t node_id) {
    for (uint32_t i = 0; i < FDCAN_RAM_WORDS; i++) {
        *ram(i) = 0;
    }
    *ram(FDCAN_RAM_FILTERS) = FDCAN_FILTER_DUAL | FDCAN_FILTER_TO_FIFO_0 |
                              FIELD(SID_ID_NMT, FDCAN_FILTER_ID1_AT) | (SID_ID_REQUEST + node_id);
    *ram(FDCAN_RAM_FILTERS + 1U) = FDCAN_FILTER_DUAL | FDCAN_FILTER_TO_FIFO_0 |
                                   FIELD(SID_ID_REFERENCES + node_id, FDCAN_FILTER_ID1_AT) |
                                   (SID_ID_REFERENCES + node_id);
    *ram(FDCAN_RAM_FILTERS + 2U) = FDCAN_FILTER_RANGE | FDCAN_FILTER_TO_FIFO_0 |
                                   FIELD(SID_ID_HEARTBEAT + 1U, FDCAN_FILTER_ID1_AT) |
                                   (SID_ID_HEARTBEAT + 127U);
}

static void set_bit_timing(void) {
    FDCAN1->NBTP = FIELD(FDCAN_NOMINAL_SEG2 - 1U, FDCAN_NBTP_NTSEG2_AT) |
                   FIELD(FDCAN_NOMINAL_SEG1 - 1U, FDCAN_NBTP_NTSEG1_AT) |
                   FIELD(FDCAN_NOMINAL_SEG2 - 1U, FDCAN_NBTP_NSJW_AT);
    FDCAN1->DBTP = FIELD(FDCAN_DATA_SEG2 - 1U, FDCAN_DBTP_DSJW_AT) |
                   FIELD(FDCAN_DATA_SEG2 - 1U, FDCAN_DBTP_DTSEG2_AT) |
                   FIELD(FDCAN_DATA_SEG1 - 1U, FDCAN_DBTP_DTSEG1_AT) | FDCAN_DBTP_TDC;
    FDCAN1->TDCR = FIELD(1U + FDCAN_DATA_SEG1, FDCAN_TDCR_TDCO_AT); // the sample point again
}

bool fdcan_init(uint32_t node_id) {
    init_pins();
    RCC->CCIPR |= RCC_CCIPR_FDCANSEL_PCLK1;
    RCC->APB1ENR1 |= RCC_APB1ENR1_FDCANEN;
    CORTEX_M4("dsb");
    FDCAN1->CCCR = FDCAN_CCCR_INIT;
    if (!stm32g474_wait(&FDCAN1->CCCR, FDCAN_CCCR_INIT, FDCAN_CCCR_INIT)) {
        return false;
    }
    FDCAN1->CCCR = FDCAN_CCCR_INIT | FDCAN_CCCR_CCE;
    FDCAN1->CCCR = FDCAN_CCCR_INIT | FDCAN_CCCR_CCE | FDCAN_CCCR_FDOE | FDCAN_CCCR_BRSE;
    set_bit_timing();
    FDCAN1->RXGFC = FDCAN_RXGFC_RRFE | FDCAN_RXGFC_RRFS | FDCAN_RXGFC_ANFE_REJECT |
                    FDCAN_RXGFC_ANFS_REJECT | FIELD(FILTERS, FDCAN_RXGFC_LSS_AT);
    FDCAN1->TXBC = 0; // a FIFO: frames leave in the order in which they were given
    init_ram(node_id);
    FDCAN1->CCCR = FDCAN_CCCR_FDOE | FDCAN_CCCR_BRSE;
    return true;
}

// ---------------------------------------------------------------- frames

// The message RAM is read and written by words only.
static void copy_from(const reg_t* element, sid_can_frame_t* frame) {
    for (uint32_t i = 0; i < frame->length; i += 4U) {
        sid_put_u32(&frame->data[i], element[2U + i / 4U]);
    }
}

static void copy_to(reg_t* element, const sid_can_frame_t* frame, uint32_t length) {
    uint8_t padded[SID_CAN_BYTES] = {0};
    for (uint32_t i = 0; i < frame->length; i++) {
        padded[i] = frame->data[i];
    }
    for (uint32_t i = 0; i < length; i += 4U) {
        element[2U + i / 4U] = sid_get_u32(&padded[i]);
    }
}

// Bus off has set INIT; without it the controller waits for a quiet bus and goes on.
static void leave_bus_off(void) {
    if ((FDCAN1->CCCR & FDCAN_CCCR_INIT) != 0U) {
        FDCAN1->CCCR &= ~FDCAN_CCCR_INIT;
    }
}

bool fdcan_receive(sid_can_frame_t* frame) {
    const uint32_t status = FDCAN1->RXF0S;
    leave_bus_off();
    if ((status & FDCAN_RXF0S_F0FL) == 0U) {
        return false;
    }
    const uint32_t get = (status >> FDCAN_RXF0S_F0GI_AT) & 3U;
    const reg_t* const element = ram(FDCAN_RAM_RX_FIFO_0 + get * FDCAN_ELEMENT_WORDS);
    const uint32_t dlc = (element[1] >> FDCAN_ELEMENT_DLC_AT) & 15U;
    frame->id = (element[0] >> FDCAN_ELEMENT_ID_AT) & 0x7FFU;
    frame->fd = (element[1] & FDCAN_ELEMENT_FDF) != 0U;
    frame->length = length_of_dlc[(frame->fd || (dlc < 8U)) ? dlc : 8U];
    copy_from(element, frame);
    FDCAN1->RXF0A = get;
    return true;
}

bool fdcan_send(const sid_can_frame_t* frame) {
    const uint32_t status = FDCAN1->TXFQS;
    if ((status & FDCAN_TXFQS_TFQF) != 0U) {
        return false;
    }
    const uint32_t put = (status >> FDCAN_TXFQS_TFQPI_AT) & 3U;
    reg_t* const element = ram(FDCAN_RAM_TX_FIFO + put * FDCAN_ELEMENT_WORDS);
    const uint32_t dlc = dlc_of_length(frame->length);
    element[0] = FIELD(frame->id, FDCAN_ELEMENT_ID_AT);
    element[1] =
        FIELD(dlc, FDCAN_ELEMENT_DLC_AT) | (frame->fd ? FDCAN_ELEMENT_FDF | FDCAN_ELEMENT_BRS : 0U);
    copy_to(element, frame, length_of_dlc[dlc]);
    CORTEX_M4("dmb"); // the element before its request
    FDCAN1->TXBAR = BIT(put);
    return true;
}
