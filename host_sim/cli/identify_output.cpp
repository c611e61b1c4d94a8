#include "cli/identify_output.hpp"

#include "cli/parameters.hpp"
#include "effects/effect.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace servoid::cli {

namespace {

sid_bin_method_t method_of(const std::string& name) {
    if (name == "dft") return SID_BIN_PLAIN_DFT;
    if (name == "constant") return SID_BIN_CONSTANT;
    if (name == "linear") return SID_BIN_LINEAR;
    if (name == "quadratic") return SID_BIN_QUADRATIC;
    return SID_BIN_CUBIC;
}

Motion motion_of(const Capture& capture) {
    return capture.linear ? Motion::linear : Motion::rotary;
}

Json to_json(const Identification& one, const Capture& capture) {
    const Motion motion = motion_of(capture);
    const auto unit = [&](Quantity q) { return unit_of(q, motion, capture.torque_in_ampere); };
    return {{"inertia", parameter(one.inertia.value, one.inertia.std, unit(Quantity::inertia))},
            {"viscous", parameter(one.viscous.value, one.viscous.std, unit(Quantity::viscous))},
            {"constant_torque",
             parameter(one.constant_torque.value, one.constant_torque.std, unit(Quantity::torque))},
            {"position_amplitude", one.position_amplitude},
            {"torque_amplitude", one.torque_amplitude},
            {"frequency_Hz", one.frequency_Hz},
            {"window", {{"first_period", one.first_period}, {"last_period", one.last_period}}},
            {"coulomb_leak", one.coulomb_leak},
            {"status", one.reason == SID_OK ? "ok" : sid_reason_text(one.reason)}};
}

// "± 0.01", or why there is no such number.
std::string spread(double std) {
    return std::isfinite(std) ? fmt::format("± {:.2g}", std) : "(spread unknown: too few periods)";
}

void print(const Output& out, const Identification& one, const Capture& capture) {
    const Motion motion = motion_of(capture);
    const auto unit = [&](Quantity q) { return unit_of(q, motion, capture.torque_in_ampere); };
    out.line(fmt::format("inertia          {} {} {}",
                         out.bold(fmt::format("{:.5g}", one.inertia.value)),
                         spread(one.inertia.std), unit(Quantity::inertia)));
    out.line(fmt::format("viscous          {:.5g} {} {}", one.viscous.value,
                         spread(one.viscous.std), unit(Quantity::viscous)));
    if (std::isfinite(one.constant_torque.value))
        out.line(fmt::format("constant torque  {:.5g} {} {}", one.constant_torque.value,
                             spread(one.constant_torque.std), unit(Quantity::torque)));
    out.line(fmt::format("at {:.5g} Hz: {:.4g} {} and {:.4g} {} of amplitude, periods {:.4g} to "
                         "{:.4g}",
                         one.frequency_Hz, one.position_amplitude, unit(Quantity::position),
                         one.torque_amplitude, unit(Quantity::torque), one.first_period,
                         one.last_period));
    if (one.coulomb_leak != 0)
        out.line(fmt::format("the model's Coulomb friction put {:.3g} {} on the inertia: taken out",
                             one.coulomb_leak, unit(Quantity::inertia)));
}

} // namespace

std::optional<Model> IdentifyArguments::read_model() const {
    if (model.empty()) return std::nullopt;
    return servoid::read_model(model);
}

IdentifyOptions IdentifyArguments::options(const Model* known) const {
    IdentifyOptions out;
    out.frequencies_Hz = frequencies;
    out.method = method_of(method);
    out.input = CaptureOptions{{}, "", {}, input}.motion().input;
    out.model = known;
    if (window.size() == 2) out.first_period = window[0], out.last_period = window[1];
    return out;
}

void add_identify_options(const Verb& verb, IdentifyArguments& a) {
    verb.add_option("--model", a.model,
                    "model file: its scales, and its Coulomb friction is taken out of the answer");
    verb.add_option("--frequency", a.frequencies, "Hz, one or more (else found)");
    verb.add_option("--window", a.window,
                    "FIRST LAST: periods after the start (else 8 10, or the last two there are)")
        .count(2);
    verb.add_option("--method", a.method,
                    "trend under the sine: cubic, quadratic, linear, constant, or plain dft")
        .one_of({"cubic", "quadratic", "linear", "constant", "dft"});
    verb.add_option("--input", a.input, "ref or measured torque").one_of({"ref", "measured"});
}

std::vector<Identification> identify_all(const std::vector<Capture>& captures,
                                         const IdentifyOptions& options) {
    std::vector<Identification> all;
    for (const Capture& capture : captures)
        for (const Identification& one : identify(capture, options))
            all.push_back(one);
    return all;
}

Json identification_json(const std::vector<Identification>& all, const Capture& capture) {
    Json json = {{"schema", "servoid.identify/1"}};
    json.update(to_json(combined(all), capture));
    if (all.size() > 1)
        for (const Identification& one : all)
            json["frequencies"].push_back(to_json(one, capture));
    return json;
}

void print_identification(const Output& out, const std::vector<Identification>& all,
                          const Capture& capture) {
    for (const Identification& one : all)
        print(out, one, capture);
    if (all.size() < 2) return;
    const Identification answer = combined(all);
    out.line(fmt::format("all together     {:.5g} {} {}", answer.inertia.value,
                         spread(answer.inertia.std),
                         unit_of(Quantity::inertia, motion_of(capture), capture.torque_in_ampere)));
}

} // namespace servoid::cli
