// Custom: a law that the user writes into the model.
//
// Linear parameters are coefficients of the regression; what is left of the law without them, if
// anything, is one more column whose coefficient is 1 and fixed.
#include "common/error.hpp"
#include "effects/effect.hpp"
#include "effects/law.hpp"
#include "effects/law_parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace servoid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

constexpr const char* kExample = R"([effects.custom.cubic]
law = "k*theta^3"

[effects.custom.cubic.parameters]
k = 1.0)";

const LawParts& parts(const EffectTerm& term) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : term.parameters)
        keys.push_back(key);
    return parts_of(term.law, keys);
}

// Names the variables that the law has.
std::string no_value(const std::string& name, const std::string& law, const AxisPoint& p) {
    std::string out = name + " = " + law + " has no finite value at";
    const double values[] = {p.time_s, p.position, p.velocity, p.acceleration, p.torque};
    for (size_t i = 0; i < law_variables().size(); ++i)
        if (mentions(law, law_variables()[i]))
            out += fmt::format("{} {} = {:.4g}", out.ends_with("at") ? "" : ",", law_variables()[i],
                               values[i]);
    return out;
}

// A position that was not recorded is no number: a law without theta does not notice.
AxisPoint point_of(const MotionView& motion, Eigen::Index i) {
    AxisPoint p;
    p.time_s = motion.time_s[i];
    p.position = motion.position.size() ? motion.position[i] : NAN;
    p.velocity = motion.velocity[i];
    p.acceleration = motion.acceleration[i];
    p.torque = motion.torque.size() ? motion.torque[i] : 0;
    return p;
}

Eigen::VectorXd along(Law& law, const MotionView& motion) {
    Eigen::VectorXd out(motion.size());
    for (Eigen::Index i = 0; i < motion.size(); ++i)
        out[i] = law.at(point_of(motion, i));
    return out;
}

class Custom : public Effect {
    const EffectInfo& info() const override {
        static const EffectInfo info = {
            .name = "custom",
            .title = "a law of your own",
            .law = "what you write, in t theta v a T and parameters of your own",
            .signature = "residual that no law of the catalogue explains",
            .reference = "docs/formats.md",
            .parameters = {},
            .replaces = {},
            .needs = {},
            .repeatable = true,
            .written = true,
            .example = kExample};
        return info;
    }

    std::vector<ParameterInfo> parameters(const EffectTerm& term) const override {
        std::vector<ParameterInfo> out;
        for (const auto* keys : {&parts(term).linear, &parts(term).shapes})
            for (const std::string& key : *keys)
                out.push_back({key, Quantity::none, -kInf, kInf, "of the law " + term.law});
        return out;
    }

    void add_to(AxisDescription& axis, const EffectTerm& term) const override {
        axis.reads_acceleration |= mentions(term.law, "a");
        axis.opposing.push_back(
            [name = term.name, law = Law(term.law, term.parameters)](const AxisPoint& p) mutable {
                const double torque = law.at(p);
                if (!std::isfinite(torque) && std::isfinite(p.velocity))
                    throw Error(ExitCode::refused, "the simulated axis comes to a place where " +
                                                       no_value(name, law.text(), p));
                return torque;
            });
    }

    int linear_count(const EffectTerm& term) const override {
        return int(parts(term).linear.size()) + parts(term).rest;
    }
    double linear_lower(int) const override { return -kInf; }
    bool linear_fixed(const EffectTerm& term, int index) const override {
        const auto& linear = parts(term).linear;
        return size_t(index) >= linear.size() || term.is_fixed(linear[size_t(index)]);
    }

    Eigen::MatrixXd columns(const EffectTerm& term, const MotionView& motion) const override {
        const LawParts& p = parts(term);
        Law law(term.law, term.parameters);
        for (const std::string& key : p.linear)
            law.set(key, 0);
        Eigen::MatrixXd out(motion.size(), linear_count(term));
        if (p.rest) out.rightCols(1) = along(law, motion);
        for (size_t i = 0; i < p.linear.size(); ++i) {
            law.set(p.linear[i], 1);
            out.col(Eigen::Index(i)) = along(law, motion);
            if (p.rest) out.col(Eigen::Index(i)) -= out.rightCols(1);
            law.set(p.linear[i], 0);
        }
        return out;
    }

    Eigen::VectorXd linear(const EffectTerm& term) const override {
        Eigen::VectorXd out = Eigen::VectorXd::Ones(linear_count(term));
        Eigen::Index next = 0;
        for (const std::string& key : parts(term).linear)
            out[next++] = term.at(key);
        return out;
    }
    void set_linear(EffectTerm& term, const Eigen::VectorXd& c) const override {
        Eigen::Index next = 0;
        for (const std::string& key : parts(term).linear)
            term.parameters[key] = c[next++];
    }

    bool uses_torque(const EffectTerm& term) const override { return mentions(term.law, "T"); }
    std::vector<std::string> shape_keys(const EffectTerm& term) const override {
        return parts(term).shapes;
    }
    // The catalogue does not know the law: nothing to start from.
    std::vector<EffectTerm> starts(const Search&) const override { return {}; }
    double search_price() const override { return 0; }

    std::string undefined(const EffectTerm& term, const MotionView& motion) const override {
        if (motion.position.size() == 0 && mentions(term.law, "theta"))
            return term.name + " depends on theta, and the position was not recorded";
        Law law(term.law, term.parameters);
        for (Eigen::Index i = 0; i < motion.size(); ++i)
            if (const AxisPoint p = point_of(motion, i); !std::isfinite(law.at(p)))
                return no_value(term.name, term.law, p);
        return "";
    }
};

} // namespace

const Effect& custom_effect() {
    static const Custom effect;
    return effect;
}

} // namespace servoid
