#include "cli/check_capture.hpp"

#include "common/error.hpp"
#include "compare/homing_search.hpp"
#include "diagnose/sanity.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace servoid::cli {

namespace {

// An answer that was printed already: it is not printed again.
class Answered : public Refusal {
  public:
    using Refusal::Refusal;
};

} // namespace

std::vector<std::string> check_capture(const Model& model,
                                       const std::vector<PreparedMotion>& motions,
                                       const Output& output) {
    std::vector<std::string> warnings = warnings_or_refusal(suspicions(model, motions));
    for (const std::string& warning : warnings)
        output.note("servoid: warning: " + warning);
    return warnings;
}

void warn_of_zero(const Model& model, const PreparedMotion& motion,
                  std::vector<std::string>& warnings, const Output& output) {
    const auto zero = offset_against(model, motion);
    if (!zero) return;
    warnings.push_back(fmt::format(
        "{}: the position zero differs from the model's by {:.4g} {}: the phases belong "
        "to another recording; at the model's zero the error would be {:.3g} %",
        motion.capture->path, zero->offset.value, unit_of(Quantity::position, model.motion),
        100 * zero->error));
    output.note("servoid: warning: " + warnings.back());
}

void print_cannot_show(const Output& output, const std::vector<Unseen>& unseen) {
    std::vector<std::pair<std::string, std::string>> groups; // why, effects
    for (const Unseen& u : unseen) {
        auto group = groups.begin();
        while (group != groups.end() && group->first != u.why)
            ++group;
        if (group == groups.end())
            groups.push_back({u.why, u.effect});
        else
            group->second += ", " + u.effect;
    }
    if (!groups.empty()) output.line("\nthis capture cannot show:");
    for (const auto& [why, effects] : groups)
        output.line("  " + effects + " (" + why + ")");
}

void or_insufficient(const Output& output, Json empty, const std::function<void()>& work) {
    try {
        work();
    } catch (const Answered&) {
        throw;
    } catch (const Refusal& refusal) {
        empty["verdict"] = verdict_name(Verdict::insufficient);
        empty["reason"] = refusal.reason();
        empty["advice"] = "record instead: " + refusal.record_instead();
        output.print_json(empty);
        throw;
    }
}

void refuse_if_insufficient(const Diagnosis& d) {
    if (d.verdict != Verdict::insufficient) return;
    if (d.shortage) throw Answered(d.shortage->why, d.shortage->record);
    throw Answered("the capture cannot answer", "a move in both directions, several speeds");
}

} // namespace servoid::cli
