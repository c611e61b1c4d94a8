#include "blind/draw_move.hpp"

#include <algorithm>
#include <cmath>

namespace blind {

namespace {

int whole_periods(double period_s, double most_s, int least) {
    return std::clamp(static_cast<int>(most_s / period_s), least, 8);
}

Drawn draw_speeds(bool whole_way, const System& system, Random& random) {
    SpeedsRequest r;
    const double top = system.speed * random.log_uniform(0.5, 1.5);
    const double slow =
        top * (whole_way ? random.uniform(0.2, 0.5) : random.log_uniform(0.06, 0.3));
    const int count = random.integer(2, whole_way ? 3 : 5);
    for (int i = 0; i < count; ++i)
        r.speeds.push_back(slow * std::pow(top / slow, i / static_cast<double>(count - 1)));
    r.acceleration = system.acceleration * random.log_uniform(0.4, 1.5);
    r.stroke = top * random.uniform(0.15, 0.5);
    r.dwell_s = random.chance(0.5) ? 0 : random.uniform(0.02, 0.1);
    r.whole_way = whole_way;
    Move one = speeds(r);
    r.cycles = whole_periods(one.duration_s / 3, random.uniform(4, 12), 1);
    Drawn out;
    out.move = speeds(r);
    out.scaled = false;
    out.most_travel = 1e9;
    if (random.chance(0.2)) out.most_travel = r.stroke * random.log_uniform(0.05, 0.5);
    return out;
}

Drawn draw_multisine(double top_Hz, double slope, Random& random) {
    MultisineRequest r;
    r.base_Hz = random.pick(std::vector<double>{0.4, 0.5, 1, 2});
    r.top_Hz = std::max(top_Hz, 4 * r.base_Hz);
    r.slope = slope;
    r.periods = whole_periods(1 / r.base_Hz, random.uniform(3, 10), 2);
    if (random.chance(0.15)) { // one long period: nothing repeats
        r.base_Hz = 1 / random.uniform(3, 7);
        r.periods = 1;
    }
    r.from_Hz = r.base_Hz;
    Drawn out;
    out.move = multisine(r, random);
    return out;
}

Drawn draw_sines(double low_Hz, double top_Hz, double slope, Random& random) {
    std::vector<double> list;
    const int count = random.integer(3, 7);
    for (int i = 0; i < count; ++i)
        list.push_back(std::round(10 * low_Hz * std::pow(top_Hz / low_Hz, i / (count - 1.0))) / 10);
    const int cycles = random.integer(3, 5);
    const double once = sines(list, slope, cycles, 1).duration_s;
    Drawn out;
    out.move = sines(list, slope, cycles, whole_periods(once, random.uniform(3, 10), 1));
    return out;
}

Drawn draw_chirp(double low_Hz, double top_Hz, double slope, Random& random) {
    const double sweep = random.uniform(1, 3);
    Drawn out;
    out.move =
        chirp(low_Hz, top_Hz, slope, sweep, whole_periods(2 * sweep, random.uniform(3, 10), 1));
    return out;
}

Drawn draw_kind(Excites what, const System& system, Random& random) {
    const bool linear = system.world.linear;
    const double wide = system.band_Hz * random.log_uniform(0.4, 1);
    const double slow_top = random.log_uniform(4, linear ? 9 : 15);
    const double tilt = linear ? random.uniform(0.3, 0.8) : random.uniform(0, 0.4);
    const double die = random.uniform(0, 1);
    switch (what) {
    case Excites::friction:
        if (die < 0.55) return draw_speeds(false, system, random);
        if (die < 0.8) return draw_multisine(slow_top, random.uniform(0.3, 1), random);
        return draw_sines(1, slow_top, 1, random);
    case Excites::position:
        if (die < 0.6) return draw_speeds(true, system, random);
        if (die < 0.9) return draw_multisine(slow_top / 2, 1, random);
        return draw_sines(0.7, slow_top / 2, 1, random);
    case Excites::dynamics:
        if (die < 0.55) return draw_multisine(wide, tilt, random);
        if (die < 0.8) return draw_chirp(2, wide, tilt, random);
        return draw_sines(4, wide, tilt, random);
    case Excites::anything:
        break;
    }
    const std::vector<Excites> all = {Excites::friction, Excites::position, Excites::dynamics};
    return draw_kind(random.pick(all), system, random);
}

double range(const std::vector<double>& x) {
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    return *high - *low;
}

} // namespace

Drawn draw_move(Excites what, const System& system, Random& random) {
    Drawn out = draw_kind(what, system, random);
    const bool linear = system.world.linear;
    out.torque_share = random.log_uniform(0.08, 0.3);
    if (out.scaled && what == Excites::position)
        out.most_travel = linear ? random.uniform(0.1, 0.5) : random.log_uniform(8, 60);
    else if (out.scaled)
        out.most_travel = linear ? random.log_uniform(0.01, 0.4) : random.log_uniform(0.1, 30);
    return out;
}

Motion motion_of(const Record& record, const Move& move, double step_s) {
    Motion m;
    const auto [low, high] = std::minmax_element(record.position.begin(), record.position.end());
    m.lowest = *low, m.highest = *high, m.travel = *high - *low;
    double sum = 0;
    for (double v : record.velocity) {
        m.top_speed = std::max(m.top_speed, std::abs(v));
        sum += v * v;
    }
    m.typical_speed = std::sqrt(sum / static_cast<double>(record.size()));
    for (double t : record.asked)
        m.top_torque = std::max(m.top_torque, std::abs(t));
    for (double share : record.stuck)
        m.stuck += share / static_cast<double>(record.size());
    m.duration_s = move.duration_s, m.top_Hz = move.top_Hz, m.step_s = step_s;
    return m;
}

double choose_amplitude(const Drawn& drawn, const System& system, const World& world) {
    const double step = world.period;
    const auto run_at = [&](double amplitude) {
        return run(world, drawn.move.sample(step, amplitude), {.substeps = 10, .seed = 1});
    };
    double amplitude = 1;
    if (!drawn.scaled) {
        const Motion m = motion_of(run_at(1), drawn.move, step);
        amplitude = std::min({1.0, drawn.most_travel / m.travel, system.rated / m.top_torque});
        return amplitude;
    }
    amplitude = drawn.most_travel / range(drawn.move.sample(step, 1));
    for (int i = 0; i < 4; ++i) {
        const Record r = run_at(amplitude);
        const Motion m = motion_of(r, drawn.move, step);
        double power = 0;
        for (double t : r.asked)
            power += t * t;
        const double torque = std::sqrt(power / static_cast<double>(r.size()));
        const double most = std::min(
            {drawn.torque_share * system.rated / torque, 1.5 * system.rated / m.top_torque,
             2.5 * system.speed / m.top_speed, drawn.most_travel / std::max(m.travel, 1e-9)});
        if (most > 0.9 && most < 1.1) break;
        amplitude *= std::clamp(most, 0.02, 5.0);
    }
    return amplitude;
}

} // namespace blind
