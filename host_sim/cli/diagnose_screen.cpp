#include "cli/check_capture.hpp"
#include "cli/diagnose_output.hpp"
#include "cli/parameters.hpp"
#include "report/bar.hpp"
#include "report/wide_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace servoid::cli {

namespace {

Tone tone_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::missing:
    case Verdict::ambiguous:
        return Tone::yellow;
    case Verdict::unknown:
        return Tone::magenta;
    case Verdict::adequate:
        return Tone::green;
    case Verdict::insufficient:
        break;
    }
    return Tone::red;
}

constexpr double kSeen = 5e-4; // a probability that is printed as more than 0.000

// Columns of the table of candidates; 0: there is no room for it.
struct Columns {
    int name, bar, change, after, unseen, note;
};

Columns columns_on(const Screen& screen) {
    const int all = screen.columns;
    if (all < 56) return {all - 22, 0, 0, 8, 8, 0};
    if (all < 76) return {21, all - 54, 17, 0, 9, 0};
    const int bar = std::clamp(all / 3 - 20, 7, 16);
    return {21, bar, 16, 0, 8, all - bar - 51};
}

struct Row {
    std::string name, bar, probability, error, unseen, note;
};

std::string text_of(const Row& row, const Columns& c) {
    std::string out =
        padded(row.name, c.name) + padded(row.bar, c.bar) + right_aligned(row.probability, 6) +
        right_aligned(row.error, c.change + c.after) + right_aligned(row.unseen, c.unseen);
    if (c.note > 8 && !row.note.empty()) out += "  " + row.note;
    return out;
}

std::string change(double before, double after) {
    std::string from = percent(before);
    from.resize(from.size() - 2); // one percent sign is enough
    return from + " → " + percent(after);
}

Row row_of(const Output& out, const Diagnosis& d, const Candidate& c, const Columns& columns) {
    const BarStyle style{std::max(0, columns.bar - 1), out.screen.utf8};
    const std::string name = out.screen.cell(c.effect, columns.name - 1);
    const bool best = &c == &d.candidates.front() && c.sound;
    return {best ? out.bold(name) : name,
            c.sound && c.probability > kSeen ? out.paint(Tone::cyan, bar(c.probability, style))
                                             : "",
            fmt::format("{:.3f}", c.probability),
            columns.change > 0 ? change(d.error_before, c.error_after) : percent(c.error_after),
            percent(c.validation_error_after),
            columns.note > 2 ? out.screen.cell(c.note, columns.note - 2) : ""};
}

void show_candidates(const Output& out, const Diagnosis& d) {
    const Columns columns = columns_on(out.screen);
    const Row head{"effect", "",    "prob.", columns.change > 0 ? "torque error" : "error",
                   "unseen", "note"};
    out.line("");
    out.line(out.dim(text_of(head, columns)));
    for (const Candidate& c : d.candidates) {
        if (!c.fitted) continue;
        const std::string text = text_of(row_of(out, d, c, columns), columns);
        out.line(c.sound ? text : out.dim(text));
    }
}

void show_best(const Output& out, const Diagnosis& d, bool ampere) {
    if (d.candidates.empty() || !d.candidates.front().sound) return;
    const Candidate& best = d.candidates.front();
    out.line("\n" + out.bold(best.effect) + ": " + best.signature, 0);
    print_parameters(out, best.parameters, d.before.model.motion, ampere);
}

void show_command(const Output& out, const std::string& what, const Command& command) {
    out.line("\n" + what);
    out.command(command);
}

} // namespace

std::string badge(const Output& out, Verdict verdict) {
    const std::string name = verdict_name(verdict);
    if (!out.screen.colour) return name;
    return out.bold(out.paint(Tone::inverse, out.paint(tone_of(verdict), " " + name + " ")));
}

void show_next(const Output& out, const Diagnosis& d, const NextCommands& next) {
    if (d.verdict == Verdict::missing && !d.candidates.empty())
        show_command(out, "to add it", add_effect_command(d.candidates.front().effect, next));
    if (!d.outside.empty())
        show_command(out, "to add the law that has no name",
                     add_law_command(d.outside, d.before.model, next));
    if (!d.next || d.next->separation < kWorthRecording) return;
    const std::vector<Command> commands = record_commands(*d.next, next);
    show_command(out, "the move that tells them apart, on a drive on the bus", commands[0]);
    show_command(out, "and with what it recorded", commands[1]);
}

void show_diagnosis(const Output& out, const Diagnosis& d, const NextCommands& next, bool ampere) {
    out.line(fmt::format("{}  torque error {}, noise floor {}, {:.3g} Hz band",
                         badge(out, d.verdict), out.bold(percent(d.error_before)),
                         percent(d.noise_floor), d.band_Hz));
    out.line(d.advice, 0);
    if (d.next) out.line(out.dim(d.next->reason), 0);
    show_candidates(out, d);
    show_best(out, d, ampere);
    print_cannot_show(out, d.cannot_show);
    show_next(out, d, next);
}

} // namespace servoid::cli
