#include "can/collector.hpp"

#include "capture/assemble.hpp"
#include "capture/csv_reader.hpp" // check_columns

namespace servoid::can {

namespace {

std::variant<BusTable, TelemetryTable> table_for(const FrameMap& map) {
    if (map.telemetry_node) return TelemetryTable(*map.telemetry_node, map.metadata);
    return BusTable(map);
}

} // namespace

Collector::Collector(const FrameMap& map) : table_(table_for(map)) {
    if (map.cia402_node) told_.emplace(*map.cia402_node);
}

void Collector::add(const Frame& frame) {
    if (told_) told_->add(frame);
    std::visit([&](auto& table) { table.add(frame); }, table_);
}

BusCaptures Collector::captures(const std::string& path, const CaptureScales& scales,
                                bool complete) const {
    if (const auto* telemetry = std::get_if<TelemetryTable>(&table_))
        return telemetry->captures(path); // it brings its own scales
    const CaptureScales all = told_ ? told_->complete(scales) : scales;
    BusCaptures out;
    for (RawTable& rows : std::get<BusTable>(table_).tables(path, out.report, complete)) {
        check_columns(rows);
        out.captures.push_back(assemble(std::move(rows), all));
    }
    return out;
}

} // namespace servoid::can
