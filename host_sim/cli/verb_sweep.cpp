// servoid sweep: the paper's experiment over frequency on the simulated drive.
#include "cli/app.hpp"
#include "cli/parameters.hpp"
#include "common/error.hpp"
#include "identify/sweep.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace servoid::cli {

namespace {

struct Options {
    Output output;
    std::string model, method = "cubic";
    SweepOptions sweep;
};

Json to_json(const Sweep& s, const Model& model) {
    const double rated = model.drive.rated_torque;
    Json out = {{"schema", "servoid.sweep/1"}, {"points", Json::array()}};
    for (const SweepPoint& p : s.points)
        out["points"].push_back(
            {{"frequency_Hz", p.answer.frequency_Hz},
             {"position_amplitude", p.answer.position_amplitude},
             {"torque_amplitude", p.answer.torque_amplitude},
             {"torque_percent_of_rated",
              rated > 0 ? Json(100 * p.answer.torque_amplitude / rated) : Json(nullptr)},
             {"inertia", p.answer.inertia},
             {"inertia_std", p.inertia_std},
             {"viscous", p.answer.viscous},
             {"error_percent", p.error_percent},
             {"status", p.answer.reason == SID_OK ? "ok" : sid_reason_text(p.answer.reason)}});
    const CorrectedInertia& c = s.corrected;
    out["inertia_corrected"] =
        parameter(c.inertia.value, c.inertia.std, unit_of(Quantity::inertia, model.motion));
    out["antiresonance"] = nullptr;
    if (c.antiresonance_Hz)
        out["antiresonance"] = parameter(c.antiresonance_Hz->value, c.antiresonance_Hz->std, "Hz");
    return out;
}

void print(const Output& out, const Sweep& s, const Model& model) {
    const std::string position = unit_of(Quantity::position, model.motion);
    const std::string inertia = unit_of(Quantity::inertia, model.motion);
    out.line(fmt::format("{:>8} {:>12} {:>12} {:>12} {:>9}", "Hz", "position " + position,
                         "torque %", "J " + inertia, "error %"));
    for (const SweepPoint& p : s.points) {
        if (p.answer.reason != SID_OK) {
            out.line(fmt::format("{:>8.4g}  {}", p.answer.frequency_Hz,
                                 sid_reason_text(p.answer.reason)));
            continue;
        }
        const double rated = model.drive.rated_torque > 0 ? model.drive.rated_torque : NAN;
        out.line(fmt::format("{:>8.4g} {:>12.5f} {:>12.2f} {:>12.4e} {:>+9.2f}",
                             p.answer.frequency_Hz, p.answer.position_amplitude,
                             100 * p.answer.torque_amplitude / rated, p.answer.inertia,
                             p.error_percent));
    }
    const CorrectedInertia& c = s.corrected;
    out.line(fmt::format("\nall frequencies together, elastic bias and Coulomb friction removed:\n"
                         "inertia        {} ± {:.2g} {}  ({:+.2f} % of the model's)",
                         out.bold(fmt::format("{:.5g}", c.inertia.value)), c.inertia.std, inertia,
                         100 * (c.inertia.value / model.inertia - 1)));
    if (c.antiresonance_Hz)
        out.line(fmt::format("antiresonance  {:.4g} ± {:.2g} Hz, from the bias alone",
                             c.antiresonance_Hz->value, c.antiresonance_Hz->std));
}

void run_sweep(Options o) {
    const Model model = read_model(o.model);
    if (!(o.sweep.to_Hz >= o.sweep.from_Hz)) throw UsageError("--to must not be below --from");
    o.sweep.session.method = o.method == "dft" ? SID_BIN_PLAIN_DFT : SID_BIN_CUBIC;
    const Sweep s = sweep(model, o.sweep);
    o.output.print_json(to_json(s, model));
    print(o.output, s, model);
}

} // namespace

void add_sweep(CLI::App& app) {
    auto o = std::make_shared<Options>();
    const Verb verb(app, "sweep", "the paper's experiment over frequency");
    verb.add_option("model", o->model, "model file (TOML) with a [controller]").required();
    verb.add_option("--from", o->sweep.from_Hz, "Hz").positive();
    verb.add_option("--to", o->sweep.to_Hz, "Hz").positive();
    verb.add_option("--step", o->sweep.step_Hz, "Hz").positive();
    verb.add_option("--amplitude", o->sweep.amplitude, "of the position reference, rad or m")
        .positive();
    verb.add_option("--torque-noise", o->sweep.torque_noise,
                    "standard deviation of a torque that disturbs the axis, per sample")
        .not_negative();
    verb.add_option("--encoder-bits", o->sweep.encoder_bits, "instead of the model's sensor")
        .between(8, 26);
    verb.add_option("--method", o->method, "cubic (trend-free) or dft (plain)")
        .one_of({"cubic", "dft"});
    verb.add_option("--seed", o->sweep.seed, "of the noise");
    add_output_options(verb, o->output);
    verb.examples("  servoid sweep system1.toml\n"
                  "  servoid sweep system2.toml --from 10 --to 200 --step 10 --json\n"
                  "  servoid sweep system1.toml --encoder-bits 15 --method dft");
    verb.callback([o] { run_sweep(*o); });
}

} // namespace servoid::cli
