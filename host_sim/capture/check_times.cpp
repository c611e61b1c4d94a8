#include "capture/checks.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace servoid {

namespace {

constexpr double tolerance = 0.01;   // of a step: what counts as uniform
constexpr double nearly_all = 0.98;  // of the steps: what counts as "uniform but for a few"
constexpr double gap_factor = 1.5;   // steps beyond this are missing samples
constexpr double own_times_gap = 20; // the same where the steps vary anyway

std::string seconds(double value) { return fmt::format("{:.6g} s", value); }

class TimeCheck {
  public:
    explicit TimeCheck(const RawTable& table)
        : table_(table), column_(*table.find(Signal::time)), time_(column_.values) {}

    Timing check() {
        check_increasing();
        measure();
        const double stated = table_.metadata_number({"sample_time_s"});
        const bool own = states_own_times();
        if (stated > 0) {
            check_thousandfold(stated);
            if (!own && on_grid(stated)) return {stated, true};
        }
        if (!own && printed_step() <= mean_ / 4 && on_grid(mean_))
            return finish(stated, {mean_, true});
        if (own) return check_own_times();
        return finish(stated, classify());
    }

  private:
    double si(double value) const { return column_.meaning.step(value); }
    size_t steps() const { return time_.size() - 1; }
    double step(size_t i) const { return time_[i + 1] - time_[i]; }
    std::string at_row(size_t row) const {
        const long line = table_.line_of(row);
        return line > 0 ? "line " + std::to_string(line) : "row " + std::to_string(row + 1);
    }

    void check_increasing() const {
        for (size_t i = 0; i < steps(); ++i) {
            if (step(i) > 0) continue;
            const std::string now = seconds(si(time_[i + 1])), before = seconds(si(time_[i]));
            table_.fail_row(i + 1, step(i) < 0
                                       ? "time steps back from " + before + " (" + at_row(i) +
                                             ") to " + now + "; expected increasing times"
                                       : "time " + now + " is repeated (" + at_row(i) +
                                             " has it too); expected increasing times");
        }
    }

    void measure() {
        std::vector<double> all(steps());
        for (size_t i = 0; i < steps(); ++i)
            all[i] = step(i);
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
        std::nth_element(all.begin(), middle, all.end());
        median_ = si(*middle);
        mean_ = si(time_.back() - time_.front()) / static_cast<double>(steps());
    }

    double printed_step() const {
        const double largest = std::max(std::abs(time_.front()), std::abs(time_.back()));
        return si(2 * column_.printing.rounding(largest));
    }

    // Times that are a uniform grid but for the rounding of their print.
    bool on_grid(double sample_time) const {
        const double largest = si(std::max(std::abs(time_.front()), std::abs(time_.back())));
        const double allowed =
            1.001 * printed_step() + 8 * largest * std::numeric_limits<double>::epsilon();
        if (allowed > sample_time) return false;
        for (size_t i = 0; i < time_.size(); ++i)
            if (std::abs(si(time_[i] - time_[0]) - static_cast<double>(i) * sample_time) > allowed)
                return false;
        return true;
    }

    bool states_own_times() const {
        const std::string sampling = lower_case(table_.metadata_text("sampling"));
        return sampling.find("own times") != std::string::npos;
    }

    // Seconds, milliseconds and microseconds taken for each other.
    void check_thousandfold(double stated) const {
        for (const double factor : {1e-6, 1e-3, 1e3, 1e6}) {
            const double ratio = median_ / stated;
            if (ratio < 0.9 * factor || ratio > 1.1 * factor) continue;
            std::string hint;
            for (const KnownColumn& known : known_columns())
                if (known.meaning.signal == Signal::time &&
                    std::abs(known.meaning.divisor / column_.meaning.divisor / factor - 1) < 0.01)
                    hint = ", or the column is really " + known.name;
            table_.fail_row(1, "time unit: " + in_quotes(column_.name) + " steps by " +
                                   seconds(median_) + " but metadata sample_time_s is " +
                                   seconds(stated) + "; one of the two units is wrong" + hint);
        }
    }

    Timing finish(double stated, Timing timing) const {
        const auto agrees = [&](double T) { return std::abs(T - stated) <= tolerance * stated; };
        if (stated > 0 && !agrees(mean_) && !agrees(median_))
            table_.fail_metadata("sample_time_s", "metadata sample_time_s is " + seconds(stated) +
                                                      " but the times step by " + seconds(median_) +
                                                      "; expected them to agree within 1 %");
        return timing;
    }

    [[noreturn]] void fail_gap(size_t i) const {
        const double missing = std::max(1.0, std::round(si(step(i)) / median_) - 1);
        table_.fail_row(
            i + 1,
            fmt::format("gap of {:.0f} samples: time jumps from {} ({}) to {}; expected a step "
                        "of {}",
                        missing, seconds(si(time_[i])), at_row(i), seconds(si(time_[i + 1])),
                        seconds(median_)));
    }

    void fail_at_gap(double factor) const {
        for (size_t i = 0; i < steps(); ++i)
            if (si(step(i)) > factor * median_) fail_gap(i);
    }

    Timing check_own_times() const {
        fail_at_gap(own_times_gap);
        return {median_, false};
    }

    // Whether a step is a whole number of sample times: rows were lost, the clock was even.
    bool whole(double step) const {
        const double samples = step / median_;
        return std::abs(samples - std::round(samples)) <= 2 * tolerance * samples && samples > 0.5;
    }

    Timing classify() const {
        size_t even = 0, multiples = 0;
        for (size_t i = 0; i < steps(); ++i) {
            even += std::abs(si(step(i)) - median_) <= tolerance * median_;
            multiples += whole(si(step(i)));
        }
        const double all = static_cast<double>(steps());
        if (even == steps()) return {mean_, true};
        if (static_cast<double>(even) >= nearly_all * all) {
            fail_at_gap(gap_factor);
            fail_jitter();
        }
        if (static_cast<double>(multiples) >= nearly_all * all) fail_at_gap(gap_factor);
        return check_own_times();
    }

    void fail_jitter() const {
        for (size_t i = 0; i < steps(); ++i)
            if (std::abs(si(step(i)) - median_) > tolerance * median_)
                table_.fail_row(i + 1, "uneven time: a step of " + seconds(si(step(i))) +
                                           " among steps of " + seconds(median_) +
                                           "; expected within 1 %, or metadata `# sampling = own "
                                           "times` if the times are right");
    }

    const RawTable& table_;
    const RawColumn& column_;
    const std::vector<double>& time_;
    double median_ = 0, mean_ = 0; // steps in s
};

} // namespace

Timing check_times(const RawTable& table) { return TimeCheck(table).check(); }

} // namespace servoid
