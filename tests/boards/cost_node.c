#include "cost.h"

#define REFERENCES 64U

static sid_node_t node;
static sid_node_t saved;
static sid_node_config_t config;
static sid_frequency_t plan;
static sid_result_t result;
static sid_row_t rows[64];
static int32_t references[REFERENCES];
static sid_sample_t in;
static sid_command_t out;

__attribute__((noinline)) static void nothing(sid_node_t* n, const sid_sample_t* sample,
                                              sid_command_t* command) {
    __asm__ volatile("" ::"r"(n), "r"(sample), "r"(command));
}
static void empty(void) { nothing(&node, &in, &out); }
static void step(void) { sid_node_step(&node, &in, &out); }

static bool power_up(void) {
    config.axis.sample_rate_uHz = 8000000000U;
    config.identify.results = &result;
    config.plan = &plan;
    config.plan_capacity = 1;
    config.node_id = 1;
    config.master_id = 127;
    config.rows = rows;
    config.row_count = 64;
    config.references = references;
    config.reference_count = REFERENCES;
    return sid_node_init(&node, &config);
}

static bool write(uint16_t index, uint8_t sub, uint32_t value, uint32_t bytes) {
    sid_can_frame_t frame = {SID_ID_REQUEST + 1U, 8, false, {0}};
    sid_can_frame_t answer;
    frame.data[0] = (uint8_t)(0x23U | ((4U - bytes) << 2));
    sid_put_u16(&frame.data[1], index);
    frame.data[3] = sub;
    sid_put_u32(&frame.data[4], value);
    return sid_node_receive(&node, &frame, &answer) && (answer.data[0] == 0x60U);
}

static bool give_references(uint32_t count) {
    sid_can_frame_t frame = {SID_ID_REFERENCES + 1U, 64, true, {1, 14}};
    sid_can_frame_t answer;
    for (uint32_t first = 0; first < count; first += 14U) {
        sid_put_u32(&frame.data[4], first);
        (void)sid_node_receive(&node, &frame, &answer);
    }
    return true;
}

static bool start(sid_run_kind_t kind) {
    bool good = power_up();
    step();
    good = write(0x2A01, 1, 77, 4) && good;
    if (kind == SID_RUN_STREAM) {
        good = write(0x2A01, 3, 56, 4) && give_references(56) && good;
    } else {
        good = write(0x2A05, 1, 100000000, 4) && write(0x2A06, 1, 300000, 4) && good;
        good = write(0x2A03, 1, 1, 1) && write(0x2A01, 2, SID_RUN_IDENTIFY, 1) && good;
    }
    return write(0x2A01, 4, 1, 4) && good;
}

static void over_samples(cost_t* cost, const char* name) {
    cost->name = name;
    cost->call = step;
    cost->empty = empty;
    cost->state = (uint32_t*)(void*)&node;
    cost->saved = (const uint32_t*)(const void*)&saved;
    cost->words = sizeof(node) / 4U;
    saved = node;
    for (uint32_t i = cost->cases % 5U; i < COST_SAMPLES; i += 5U) {
        in = cost_sample(i);
        cost_measure(cost);
    }
    in = cost_sample(0);
}

// Every kind of run in its first samples, later, and after its end. The sample that begins a run
// also copies what belongs to it, and is a case of its own.
bool cost_of_node(void) {
    static cost_t hold, session, stream, begin;
    static cost_t* const runs[2] = {&session, &stream};
    static const char* const names[2] = {"sid_node_step, session", "sid_node_step, streamed move"};
    bool good = power_up();
    in = cost_sample(0);
    over_samples(&hold, "sid_node_step, no run");
    for (uint32_t kind = 0; kind < 2U; kind++) {
        good = start((kind == 0U) ? SID_RUN_IDENTIFY : SID_RUN_STREAM) && good;
        if (kind == 0U) {
            over_samples(&begin, "sid_node_step, a session's first sample");
        }
        step();
        for (uint32_t i = 0; i < 4U; i++) {
            over_samples(runs[kind], names[kind]);
            for (uint32_t k = 0; k < 27U; k++) {
                step();
            }
        }
        in.torque_pu_q20 = INT32_MAX; // held from here on
        step();
        over_samples(runs[kind], names[kind]);
    }
    cost_report(&hold);
    cost_report(&session);
    cost_report(&stream);
    cost_report(&begin);
    return good;
}
