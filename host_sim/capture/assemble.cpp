#include "capture/assemble.hpp"

#include "capture/checks.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace servoid {

namespace {

constexpr double turn_rad = 2 * std::numbers::pi;

class Assembler {
  public:
    Assembler(RawTable table, const CaptureScales& scales)
        : table_(std::move(table)), scales_(scales) {}

    Capture assemble() {
        capture_.path = table_.path;
        for (const auto& [key, entry] : table_.metadata)
            capture_.metadata[key] = entry.value;
        decide_axis();
        resolve_scales();
        read_options();
        const Timing timing = check_times(table_);
        capture_.sample_time_s = timing.sample_time_s;
        capture_.uniform = timing.uniform;
        find_quanta();
        for (RawColumn& column : table_.columns)
            convert(column);
        if (!capture_.position.empty() && !capture_.velocity.empty())
            check_velocity_unit(table_, capture_.time_s, capture_.position, capture_.velocity);
        return std::move(capture_);
    }

  private:
    void decide_axis() {
        capture_.linear = scales_.linear || table_.metadata.contains("metres_per_count");
        if (table_.metadata.contains("motion")) capture_.linear = stated_linear();
        for (const RawColumn& column : table_.columns)
            if (column.meaning.family != Family::either)
                capture_.linear = column.meaning.family == Family::linear;
    }

    bool stated_linear() const {
        const std::string motion = table_.metadata_text("motion");
        if (motion != "linear" && motion != "rotary")
            table_.fail_metadata("motion", "metadata motion = " + in_quotes(motion) +
                                               "; expected rotary or linear");
        return motion == "linear";
    }

    void resolve_scales() {
        double constant = scales_.torque_constant;
        if (constant <= 0)
            constant =
                table_.metadata_number({"torque_constant_Nm_per_A", "force_constant_N_per_A"});
        bool other_torque = false, ampere = false;
        for (RawColumn& column : table_.columns) {
            ColumnMeaning& meaning = column.meaning;
            const bool torque =
                meaning.signal == Signal::torque || meaning.signal == Signal::torque_ref;
            if (meaning.needs == Scale::torque_constant) {
                ampere = true;
                if (constant > 0) meaning.factor *= constant, meaning.offset *= constant;
            } else if (torque)
                other_torque = true;
            if (meaning.needs == Scale::rated_torque) meaning.factor *= rated_torque(column);
            if (meaning.needs == Scale::position_per_count) meaning.factor *= per_count(column);
        }
        capture_.torque_in_ampere = ampere && constant <= 0;
        if (capture_.torque_in_ampere && other_torque)
            table_.fail_header(
                "one torque is in A and the other is not; add metadata "
                "`# torque_constant_Nm_per_A = ...`, or drive.torque_constant to the "
                "model");
    }

    double rated_torque(const RawColumn& column) const {
        if (scales_.rated_torque > 0) return scales_.rated_torque;
        const double rated = table_.metadata_number({"rated_torque_Nm", "rated_force_N"});
        if (rated > 0) return rated;
        table_.fail_header("column " + in_quotes(column.name) +
                           " is in per mille of the rated torque, "
                           "which is not known; add metadata `# rated_torque_Nm = ...` (or "
                           "rated_force_N), or drive.rated_torque to the model");
    }

    double per_count(const RawColumn& column) const {
        if (scales_.position_per_count > 0) return scales_.position_per_count;
        const double counts = table_.metadata_number({"counts_per_rev"});
        if (counts > 0 && !capture_.linear) return turn_rad / counts;
        const double metres = table_.metadata_number({"metres_per_count"});
        if (metres > 0 && capture_.linear) return metres;
        const std::string key = capture_.linear ? "metres_per_count" : "counts_per_rev";
        table_.fail_header("column " + in_quotes(column.name) +
                           " is in counts of unknown size; add "
                           "metadata `# " +
                           key + " = ...`, or sensor." + key + " to the model");
    }

    void read_options() {
        const std::string hold = table_.metadata_text("torque_hold");
        if (!hold.empty() && hold != "none" && hold != "held")
            table_.fail_metadata("torque_hold", "metadata torque_hold = " + in_quotes(hold) +
                                                    "; expected none or held");
        capture_.ref_held = hold != "none";
        capture_.torque_delay_s = non_negative("torque_delay_s").value_or(0);
        const double period = table_.metadata_number({"period_s"});
        if (period > 0) capture_.period_s = period;
    }

    std::optional<double> non_negative(const std::string& key) const {
        const auto found = table_.metadata.find(key);
        if (found == table_.metadata.end()) return std::nullopt;
        const auto value = parse_number(found->second.value);
        if (!value || *value < 0)
            table_.fail_metadata(key, "metadata " + key + " = " + in_quotes(found->second.value) +
                                          "; expected a number, zero or above");
        return value;
    }

    // A stated step is taken, a count is a count; else the column is looked at.
    double quantum(Signal signal, const std::string& key) {
        const RawColumn* column = table_.find(signal);
        if (!column) return 0;
        if (const auto stated = non_negative(key)) return *stated;
        if (column->meaning.needs == Scale::position_per_count) return column->meaning.step(1);
        return column->meaning.step(find_quantum(column->values, column->printing));
    }

    void find_quanta() {
        const bool linear = capture_.linear;
        capture_.position_quantum =
            quantum(Signal::position, linear ? "position_quantum_m" : "position_quantum_rad");
        capture_.velocity_quantum =
            quantum(Signal::velocity, linear ? "velocity_quantum_m_s" : "velocity_quantum_rad_s");
        const Signal torque = table_.find(Signal::torque) ? Signal::torque : Signal::torque_ref;
        capture_.torque_quantum = quantum(torque, torque_quantum_key(capture_));
        for (const Signal signal : {Signal::position, Signal::position_ref, Signal::load_position})
            if (const RawColumn* column = table_.find(signal)) check_wrap(*column);
    }

    static std::string torque_quantum_key(const Capture& capture) {
        if (capture.torque_in_ampere) return "torque_quantum_A";
        return capture.linear ? "torque_quantum_N" : "torque_quantum_Nm";
    }

    void check_wrap(const RawColumn& column) const {
        const double to_file_units = 1 / column.meaning.step(1);
        const bool sensor = column.meaning.signal == Signal::position;
        check_unwrapped(table_, column, capture_.linear ? 0 : turn_rad * to_file_units,
                        sensor ? capture_.position_quantum * to_file_units : 0);
    }

    std::vector<double>& target(Signal signal) {
        switch (signal) {
        case Signal::time:
            return capture_.time_s;
        case Signal::torque_ref:
            return capture_.torque_ref;
        case Signal::torque:
            return capture_.torque;
        case Signal::position:
            return capture_.position;
        case Signal::velocity:
            return capture_.velocity;
        case Signal::position_ref:
            return capture_.position_ref;
        case Signal::velocity_ref:
            return capture_.velocity_ref;
        default:
            return capture_.load_position;
        }
    }

    // Moves the values: a long capture should not be held twice.
    void convert(RawColumn& column) {
        if (column.meaning.signal == Signal::segment) return convert_segments(column);
        std::vector<double>& values = target(column.meaning.signal);
        values = std::move(column.values);
        const ColumnMeaning& meaning = column.meaning;
        if (meaning.factor != 1 || meaning.divisor != 1 || meaning.offset != 0)
            for (double& value : values)
                value = meaning.si(value);
    }

    void convert_segments(const RawColumn& column) {
        capture_.segment.reserve(column.values.size());
        for (size_t row = 0; row < column.values.size(); ++row) {
            const double value = column.meaning.si(column.values[row]);
            if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
                table_.fail_row(row, "column " + in_quotes(column.name) + ": " +
                                         format_number(value) +
                                         " is not a whole number; expected the label of a segment");
            capture_.segment.push_back(static_cast<int>(value));
        }
    }

    RawTable table_;
    const CaptureScales& scales_;
    Capture capture_;
};

} // namespace

Capture assemble(RawTable table, const CaptureScales& scales) {
    return Assembler(std::move(table), scales).assemble();
}

} // namespace servoid
