// How fast logs are read. Printed, judged by nobody: timings wander between machines.
#include "can/candump.hpp"

#include <benchmark/benchmark.h>

using namespace servoid::can;

namespace {

constexpr int frames = 1'000'000;

// Four messages of a drive at 1 kHz on two interfaces, with data that change.
std::string log_of(bool fd, std::uint8_t length) {
    std::string text;
    std::uint64_t counter = 0x0123456789abcdef;
    for (int i = 0; i < frames; ++i) {
        Frame frame;
        frame.time_ns = 1436509052249713000 + i * std::int64_t{250'000};
        frame.id = 0x181 + 0x100 * static_cast<std::uint32_t>(i % 4);
        frame.fd = fd;
        frame.fd_flags = fd ? 1 : 0;
        frame.length = length;
        for (size_t k = 0; k < length; ++k)
            frame.data[k] = static_cast<std::uint8_t>((counter *= 6364136223846793005) >> 56);
        text += format_candump(frame, i % 8 < 4 ? "can0" : "can1") + "\n";
    }
    return text;
}

void read_candump(benchmark::State& state) {
    const std::string text = log_of(state.range(0) != 0, static_cast<std::uint8_t>(state.range(1)));
    std::int64_t read = 0;
    for (auto _ : state) {
        CandumpReader reader(text, "bench.log");
        for (Frame frame; reader.next(frame); ++read)
            benchmark::DoNotOptimize(frame);
    }
    state.counters["frames/s"] =
        benchmark::Counter(static_cast<double>(read), benchmark::Counter::kIsRate);
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK(read_candump)
    ->Args({0, 8})
    ->Args({1, 8})
    ->Args({1, 64})
    ->ArgNames({"fd", "bytes"})
    ->Unit(benchmark::kMillisecond);

} // namespace
