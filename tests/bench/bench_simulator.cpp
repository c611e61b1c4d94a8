// How fast the host is. Printed, judged by nobody: timings wander between machines.
#include "capture/capture.hpp"
#include "common/file.hpp"
#include "compare/motion.hpp"
#include "identify/sweep.hpp"
#include "plant/simulate.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <unistd.h>

using namespace servoid;

namespace {

Model system(int number) {
    return read_model(std::string(SERVOID_SOURCE_DIR) + "/examples/system" +
                      std::to_string(number) + ".toml");
}

// The axis, its encoder and the core's loop, a sine of 30 Hz at 8 kHz. `times_real_time` is what is
// asked to be at least 1000 for system 1.
void simulated_drive(benchmark::State& state) {
    SimulatedDrive drive(system(int(state.range(0))), {});
    const double step = 2 * std::numbers::pi * 30 * drive.sample_time_s();
    double phase = 0;
    for (auto _ : state) {
        phase += step;
        benchmark::DoNotOptimize(drive.step(std::sin(phase)));
    }
    const auto samples = double(state.iterations());
    state.counters["samples/s"] = benchmark::Counter(samples, benchmark::Counter::kIsRate);
    state.counters["times_real_time"] =
        benchmark::Counter(samples * drive.sample_time_s(), benchmark::Counter::kIsRate);
}
BENCHMARK(simulated_drive)->Arg(1)->Arg(2)->ArgName("system");

// The axis alone, held by friction every half period.
void axis_alone(benchmark::State& state) {
    const Model model = system(int(state.range(0)));
    Axis axis(axis_of(model), 125e-6);
    double phase = 0;
    for (auto _ : state) {
        phase += 2 * std::numbers::pi * 30 * 125e-6;
        axis.step(0.05 * std::sin(phase));
        benchmark::DoNotOptimize(axis.position());
    }
    state.counters["times_real_time"] =
        benchmark::Counter(double(state.iterations()) * 125e-6, benchmark::Counter::kIsRate);
}
BENCHMARK(axis_alone)->Arg(1)->Arg(2)->ArgName("system");

void sweep_of_20(benchmark::State& state) {
    const Model model = system(int(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(sweep(model, {}));
}
BENCHMARK(sweep_of_20)->Arg(1)->Arg(2)->ArgName("system")->Unit(benchmark::kMillisecond);

// 25 000 rows at 8 kHz, as much as EMPS has.
Capture rows_25000() {
    Experiment e = parse_experiment("trapezoid");
    e.duration_s = 25000 * 125e-6;
    return simulate(system(1), e, 1);
}

void prepare_25000_rows(benchmark::State& state) {
    const Capture capture = rows_25000();
    for (auto _ : state)
        benchmark::DoNotOptimize(prepare_motion(capture, {}));
    state.counters["rows/s"] = benchmark::Counter(
        double(state.iterations()) * double(capture.rows()), benchmark::Counter::kIsRate);
}
BENCHMARK(prepare_25000_rows)->Unit(benchmark::kMillisecond);

struct CsvFile {
    CsvFile() { write_file(path, format_capture_csv(rows_25000())); }
    ~CsvFile() { std::filesystem::remove(path); }
    std::string path = std::filesystem::temp_directory_path() /
                       ("servoid_bench_" + std::to_string(getpid()) + ".csv");
};

void read_csv_file(benchmark::State& state) {
    const CsvFile file;
    for (auto _ : state)
        benchmark::DoNotOptimize(read_capture(file.path));
    state.SetBytesProcessed(int64_t(state.iterations()) *
                            int64_t(std::filesystem::file_size(file.path)));
}
BENCHMARK(read_csv_file)->Unit(benchmark::kMillisecond);

} // namespace
