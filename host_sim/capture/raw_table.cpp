#include "capture/raw_table.hpp"

#include "common/error.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

double Printing::rounding(double magnitude) const {
    // Numbers with all their digits were mostly computed, and are off by a few of the last ones.
    constexpr int exact_digits = 14;
    const double fixed = std::pow(10.0, -decimals);
    const double size = magnitude > 0 ? std::floor(std::log10(magnitude)) + 1 : -300;
    return 0.5 * std::max(fixed, std::pow(10.0, size - std::min(significant, exact_digits)));
}

bool is_meaningful_metadata(const std::string& key) {
    static const std::vector<std::string> keys = {
        "sample_time_s",          "sampling",           "torque_hold",
        "torque_delay_s",         "period_s",           "motion",
        "rated_torque_Nm",        "rated_force_N",      "torque_constant_Nm_per_A",
        "force_constant_N_per_A", "counts_per_rev",     "metres_per_count",
        "position_quantum_rad",   "position_quantum_m", "velocity_quantum_rad_s",
        "velocity_quantum_m_s",   "torque_quantum_Nm",  "torque_quantum_N",
        "torque_quantum_A"};
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

const RawColumn* RawTable::find(Signal signal) const {
    for (const RawColumn& column : columns)
        if (column.meaning.signal == signal) return &column;
    return nullptr;
}

long RawTable::line_of(size_t row) const {
    const auto after = std::upper_bound(runs.begin(), runs.end(), row,
                                        [](size_t r, const auto& run) { return r < run.first; });
    if (after == runs.begin()) return 0;
    const auto& [first, line] = *(after - 1);
    return line + static_cast<long>(row - first);
}

void RawTable::fail_row(size_t row, const std::string& reason) const {
    const long line = line_of(row);
    throw FileError(path, line,
                    line > 0 ? reason : "row " + std::to_string(row + 1) + ": " + reason);
}

void RawTable::fail_header(const std::string& reason) const {
    throw FileError(path, header_line, reason);
}

void RawTable::fail_metadata(const std::string& key, const std::string& reason) const {
    const auto found = metadata.find(key);
    const long line = found == metadata.end() ? 0 : found->second.line;
    throw FileError(line > 0 ? metadata_path : path, line, reason);
}

double RawTable::metadata_number(const std::vector<std::string>& keys) const {
    for (const auto& key : keys) {
        const auto found = metadata.find(key);
        if (found == metadata.end()) continue;
        const auto value = parse_number(found->second.value);
        if (!value || *value <= 0)
            fail_metadata(key, "metadata " + key + " = " + in_quotes(found->second.value) +
                                   "; expected a number above zero");
        return *value;
    }
    return 0;
}

std::string RawTable::metadata_text(const std::string& key) const {
    const auto found = metadata.find(key);
    return found == metadata.end() ? "" : found->second.value;
}

} // namespace servoid
