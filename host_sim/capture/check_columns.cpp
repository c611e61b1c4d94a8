#include "capture/csv_reader.hpp"
#include "common/error.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <map>

namespace servoid {

namespace {

void check_duplicates(const RawTable& table) {
    std::map<Signal, const RawColumn*> seen;
    for (const RawColumn& column : table.columns) {
        const auto [found, fresh] = seen.emplace(column.meaning.signal, &column);
        if (fresh) continue;
        const std::string& first = found->second->name;
        if (first == column.name) table.fail_header("duplicate column " + in_quotes(column.name));
        table.fail_header("columns " + in_quotes(first) + " and " + in_quotes(column.name) +
                          " are both the " + signal_name(column.meaning.signal) +
                          "; keep one of them");
    }
}

void check_needed(const RawTable& table) {
    const auto has = [&](Signal signal) { return table.find(signal) != nullptr; };
    if (!has(Signal::time))
        table.fail_header("no time column; expected time_s, time_ms or time_us");
    if (!has(Signal::torque) && !has(Signal::torque_ref))
        table.fail_header("no torque column; expected one of torque, torque_ref, force, force_ref, "
                          "current, current_ref with a unit, such as torque_Nm");
    if (!has(Signal::position) && !has(Signal::velocity))
        table.fail_header("neither position nor velocity; expected one of them, such as "
                          "position_rad, position_m or velocity_rpm");
}

void check_families(const RawTable& table) {
    const RawColumn* first[2] = {nullptr, nullptr};
    for (const RawColumn& column : table.columns) {
        if (column.meaning.family == Family::either) continue;
        const RawColumn*& slot = first[column.meaning.family == Family::linear ? 1 : 0];
        if (!slot) slot = &column;
    }
    if (first[0] && first[1])
        table.fail_header("column " + in_quotes(first[0]->name) + " is of a rotary axis, column " +
                          in_quotes(first[1]->name) + " of a linear one; expected one kind");
}

} // namespace

void check_columns(const RawTable& table) {
    check_duplicates(table);
    check_needed(table);
    check_families(table);
}

std::vector<RawColumn> mapped_columns(const SignalMap& map,
                                      const std::vector<std::string>& available,
                                      const std::string& path) {
    std::vector<RawColumn> columns;
    for (const auto& [signal, entry] : map.signals) {
        const auto count = std::count(available.begin(), available.end(), entry.column);
        if (count == 0)
            throw FileError(map.path, entry.line,
                            "signal " + signal + " asks for column " + in_quotes(entry.column) +
                                ", which is not in " + path + "; it has " + join(available));
        if (count > 1)
            throw FileError(map.path, entry.line,
                            "column " + in_quotes(entry.column) + " is in " + path +
                                " more than once");
        for (const RawColumn& other : columns)
            if (other.name == entry.column)
                throw FileError(map.path, entry.line,
                                "column " + in_quotes(entry.column) +
                                    " is asked for by two signals");
        for (const KnownColumn& bare : bare_signals())
            if (bare.name == signal) {
                columns.push_back({entry.column, bare.meaning, {}, {}});
                columns.back().meaning.factor = entry.scale;
                columns.back().meaning.offset = entry.offset;
            }
    }
    return columns;
}

} // namespace servoid
