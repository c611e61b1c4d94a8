#include "plant/experiment.hpp"

#include "common/error.hpp"
#include "common/toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace servoid {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

using Keys = std::map<std::string, double>;

struct Kind {
    const char* name;
    Keys defaults;
    Experiment (*make)(const Keys&);
};

Experiment sine(const Keys& k) {
    const double w = kTurn * k.at("frequency_Hz"), a = k.at("amplitude");
    Experiment e;
    e.duration_s = k.at("periods") / k.at("frequency_Hz");
    e.period_s = 1 / k.at("frequency_Hz");
    e.position_ref = [=](double t) { return a * std::sin(w * t); };
    return e;
}

// The frequency of which all lines are multiples: 5, 15, 25 Hz repeat after 0.2 s, not 0.1 s.
// Euclid's algorithm, with a rest that is only rounding taken for none.
double base_frequency(double from_Hz, double step_Hz) {
    double a = from_Hz, b = step_Hz;
    while (b > 1e-6 * step_Hz) {
        const double rest = std::abs(a - b * std::round(a / b));
        a = b, b = rest;
    }
    return a;
}

Experiment multisine(const Keys& k) {
    struct Line {
        double w, phase;
    };
    std::vector<Line> lines;
    std::mt19937_64 random(static_cast<unsigned long>(k.at("seed")));
    std::uniform_real_distribution<double> phase(0, kTurn);
    for (double f = k.at("from_Hz"); f <= k.at("to_Hz") * (1 + 1e-9); f += k.at("step_Hz"))
        lines.push_back({kTurn * f, phase(random)});
    const double a = k.at("amplitude") / std::sqrt(double(lines.size()));
    Experiment e;
    e.period_s = 1 / base_frequency(k.at("from_Hz"), k.at("step_Hz"));
    e.duration_s = k.at("periods") * *e.period_s;
    e.position_ref = [=](double t) {
        double sum = 0; // from rest: each line less its own start
        for (const Line& l : lines)
            sum += std::sin(l.w * t + l.phase) - std::sin(l.phase);
        return a * sum;
    };
    return e;
}

// One move of length 1·stroke with limited velocity and acceleration: position after time t.
struct Ramp {
    double stroke, velocity, acceleration;
    double top() const { return std::min(velocity, std::sqrt(stroke * acceleration)); }
    double duration() const { return stroke / top() + top() / acceleration; }
    double at(double t) const {
        const double v = top(), ta = v / acceleration, td = duration();
        t = std::clamp(t, 0.0, td);
        if (t < ta) return acceleration * t * t / 2;
        if (t > td - ta) return stroke - acceleration * (td - t) * (td - t) / 2;
        return v * ta / 2 + v * (t - ta);
    }
};

Experiment trapezoid(const Keys& k) {
    const Ramp ramp{k.at("stroke"), k.at("velocity"), k.at("acceleration")};
    const double dwell = k.at("dwell"), leg = ramp.duration() + dwell;
    Experiment e;
    e.period_s = 2 * leg;
    e.duration_s = k.at("cycles") * 2 * leg;
    e.position_ref = [=](double t) {
        const double in = std::fmod(t, 2 * leg);
        return in < leg ? ramp.at(in) : ramp.stroke - ramp.at(in - leg);
    };
    return e;
}

// Speed v(t) that ramps up over a tenth of the run: its integral.
double soft_run(double velocity, double duration, double t) {
    const double ramp = 0.1 * duration;
    return t < ramp ? velocity * t * t / (2 * ramp) : velocity * (t - ramp / 2);
}

Experiment constant_speed(const Keys& k) {
    const double v = k.at("velocity"), duration = k.at("duration");
    Experiment e;
    e.duration_s = duration;
    e.position_ref = [=](double t) { return soft_run(v, duration, t); };
    return e;
}

Experiment speeds(const Keys& k) {
    std::vector<double> list;
    const int count = int(k.at("count"));
    for (int i = 0; i < count; ++i) {
        const double share = count > 1 ? double(i) / (count - 1) : 0;
        const double v = k.at("from") + share * (k.at("to") - k.at("from"));
        list.push_back(v), list.push_back(-v);
    }
    const double run = k.at("duration");
    Experiment e;
    e.duration_s = run * double(list.size());
    e.position_ref = [=](double t) {
        double start = 0;
        size_t i = 0;
        for (; i + 1 < list.size() && t >= run; ++i, t -= run)
            start += soft_run(list[i], run, run);
        return start + soft_run(list[i], run, t);
    };
    e.segment = [=](double t) { return int(std::min(t / run, double(list.size() - 1))); };
    return e;
}

// There and back at one speed after the other, then again from the first.
Experiment staircase(const Keys& k) {
    struct Step {
        double begins;
        Ramp ramp;
    };
    std::vector<Step> steps;
    double length = 0;
    const double stroke = k.at("stroke"), from = k.at("from"), to = k.at("to");
    const int count = int(k.at("count"));
    if (!(from > 0) || !(to > 0) || k.at("count") > 1000)
        throw UsageError("experiment: a staircase takes up to 1000 speeds above zero");
    for (int i = 0; i < count; ++i) {
        const double v = count > 1 ? from + (to - from) * i / (count - 1) : from;
        steps.push_back({length, {stroke, v, k.at("acceleration")}});
        length += 2 * steps.back().ramp.duration();
    }
    Experiment e;
    e.period_s = length;
    e.duration_s = k.at("cycles") * length;
    e.position_ref = [=](double t) {
        const double in = std::fmod(t, length);
        size_t i = steps.size() - 1;
        while (i > 0 && in < steps[i].begins)
            --i;
        const Ramp& ramp = steps[i].ramp;
        const double there = in - steps[i].begins, back = there - ramp.duration();
        return back < 0 ? ramp.at(there) : stroke - ramp.at(back);
    };
    return e;
}

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all = {
        {"sine", {{"frequency_Hz", 100}, {"amplitude", 1}, {"periods", 10}}, sine},
        {"multisine",
         {{"from_Hz", 5},
          {"to_Hz", 250},
          {"step_Hz", 5},
          {"amplitude", 0.1},
          {"periods", 10},
          {"seed", 1}},
         multisine},
        {"trapezoid",
         {{"stroke", 6.2831853071795862},
          {"velocity", 50},
          {"acceleration", 2000},
          {"dwell", 0},
          {"cycles", 4}},
         trapezoid},
        {"constant_speed", {{"velocity", 20}, {"duration", 1}}, constant_speed},
        {"speeds", {{"from", 5}, {"to", 100}, {"count", 6}, {"duration", 0.5}}, speeds},
        {"staircase",
         {{"stroke", 6.2831853071795862},
          {"from", 5},
          {"to", 50},
          {"count", 4},
          {"acceleration", 2000},
          {"cycles", 3}},
         staircase},
    };
    return all;
}

const Keys& common_keys() {
    static const Keys keys = {{"torque_noise", 0}, {"rest", 0}, {"start", 0}};
    return keys;
}

std::string known(const Keys& keys) {
    std::string out;
    for (const auto& [key, value] : keys)
        out += (out.empty() ? "" : ", ") + key;
    return out;
}

void check_range(const std::string& key, double value) {
    static const std::vector<std::string> any = {"velocity", "seed",  "torque_noise", "rest",
                                                 "start",    "dwell", "from",         "to"};
    const bool free = std::find(any.begin(), any.end(), key) != any.end();
    if (!std::isfinite(value) || (!free && value <= 0) || (key == "rest" && value < 0) ||
        (key == "dwell" && value < 0) || (key == "torque_noise" && value < 0))
        throw UsageError(fmt::format("experiment: {} = {} is out of range", key, value));
}

Experiment make(const std::string& name, const Keys& given) {
    for (const Kind& kind : kinds()) {
        if (name != kind.name) continue;
        Keys keys = kind.defaults;
        keys.insert(common_keys().begin(), common_keys().end());
        for (const auto& [key, value] : given) {
            if (!keys.count(key))
                throw UsageError(fmt::format("experiment: {} has no key {}; it knows {}", name, key,
                                             known(keys)));
            check_range(key, value);
            keys[key] = value;
        }
        Experiment e = kind.make(keys);
        if (!(e.duration_s <= 3600)) throw UsageError("experiment: longer than an hour");
        e.torque_noise = keys.at("torque_noise");
        if (const double start = keys.at("start"); start != 0) {
            e.start = start;
            e.position_ref = [inner = e.position_ref, start](double t) { return start + inner(t); };
        }
        if (const double rest = keys.at("rest"); rest > 0) {
            e.duration_s += rest;
            e.position_ref = [inner = e.position_ref, rest](double t) {
                return t < rest ? inner(0) : inner(t - rest);
            };
        }
        return e;
    }
    std::string names;
    for (const Kind& kind : kinds())
        names += (names.empty() ? "" : ", ") + std::string(kind.name);
    throw UsageError(fmt::format("experiment: no kind {}; there are {}", name, names));
}

Experiment from_text(const std::string& text) {
    const size_t colon = text.find(':');
    Keys keys;
    std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
    while (!rest.empty()) {
        const size_t comma = rest.find(',');
        const std::string item = rest.substr(0, comma);
        rest = comma == std::string::npos ? "" : rest.substr(comma + 1);
        const size_t equals = item.find('=');
        double value = 0;
        const char* end = item.data() + item.size();
        const char* begin = equals == std::string::npos ? end : item.data() + equals + 1;
        const auto parsed = std::from_chars(begin, end, value);
        if (begin == end || parsed.ec != std::errc() || parsed.ptr != end)
            throw UsageError("experiment: '" + item + "' is not key=number");
        keys[item.substr(0, equals)] = value;
    }
    return make(text.substr(0, colon), keys);
}

Experiment from_file(const std::string& path) {
    try {
        const toml::table table = toml::parse_file(path);
        Keys keys;
        for (const auto& [key, node] : table) {
            if (key.str() == "kind") continue;
            const std::optional<double> value = node.value<double>();
            if (!value)
                throw FileError(path, long(node.source().begin.line),
                                std::string(key.str()) + " is not a number");
            keys[std::string(key.str())] = *value;
        }
        const std::optional<std::string> kind = table["kind"].value<std::string>();
        if (!kind) throw FileError(path, 1, "no kind = \"...\" (sine, trapezoid, ...)");
        return make(*kind, keys);
    } catch (const toml::parse_error& e) {
        throw FileError(path, long(e.source().begin.line), std::string(e.description()));
    } catch (const UsageError& e) {
        throw FileError(path, 0, e.what());
    }
}

} // namespace

Experiment parse_experiment(const std::string& text) {
    Experiment e = text.ends_with(".toml") ? from_file(text) : from_text(text);
    e.text = text;
    return e;
}

} // namespace servoid
