#include "can/frame_map.hpp"

#include "can/telemetry.hpp"

#include "common/error.hpp"
#include "common/file.hpp"
#include "common/text.hpp"
#include "common/toml_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace servoid::can {

namespace {

constexpr int kMostBytes = 64;

long whole(const TomlView& table, const std::string& key, long least, long most) {
    const double value = table.number(key);
    if (value != std::floor(value) || value < double(least) || value > double(most))
        table.fail(key, fmt::format("{} is {}; expected a whole number from {} to {}",
                                    table.full(key), value, least, most));
    return long(value);
}

bool yes(const TomlView& table, const std::string& key) {
    if (!table.has(key)) return false;
    const toml::node& node = *table.raw().get(key);
    if (!node.is_boolean())
        table.fail(key, table.full(key) + " must be true or false, not " + kind_of(node));
    return node.value<bool>().value();
}

FrameId frame_id(const TomlView& table, const std::string& key) {
    const long id = whole(table, key, 0, 0x1FFFFFFF);
    return {std::uint32_t(id), id > 0x7FF || yes(table, "extended")};
}

FieldKind kind_of_field(const TomlView& table, int length) {
    const std::string type = table.text_or("type", "integer");
    if (type == "float" && length == 32) return FieldKind::float32;
    if (type == "float" && length == 64) return FieldKind::float64;
    if (type != "integer")
        table.fail("type",
                   table.full("type") + " must be integer, or float with a length of 32 or 64");
    return yes(table, "signed") ? FieldKind::signed_integer : FieldKind::unsigned_integer;
}

Field read_field(const TomlView& table, const std::string& name) {
    table.allow_only({"id", "extended", "start_bit", "length", "byte_order", "signed", "type",
                      "scale", "offset"});
    Field field;
    field.name = name;
    field.frame = frame_id(table, "id");
    field.start_bit = int(whole(table, "start_bit", 0, 8 * kMostBytes - 1));
    field.length = int(whole(table, "length", 1, 64));
    const std::string order = table.text_or("byte_order", "little");
    if (order != "little" && order != "big")
        table.fail("byte_order", table.full("byte_order") + " must be little or big");
    field.order = order == "big" ? ByteOrder::big : ByteOrder::little;
    field.kind = kind_of_field(table, field.length);
    if (table.has("scale")) field.scale = table.number("scale");
    if (table.has("offset")) field.offset = table.number("offset");
    if (field.scale == 0) table.fail("scale", table.full("scale") + " must not be zero");
    if (const std::string fault = servoid::can::fault_of(field, kMostBytes); !fault.empty())
        table.fail("start_bit", table.full(name) + ": " + fault);
    return field;
}

// "torque" is in SI; "torque_permille" in what its name says.
ColumnMeaning meaning_of(const std::string& name, const std::string& path, long line) {
    if (const ColumnMeaning* known = find_column(name)) return *known;
    for (const KnownColumn& bare : bare_signals())
        if (bare.name == name) return bare.meaning;
    throw FileError(path, line, column_mistake(name));
}

MappedSignal read_signal(const TomlView& table, const std::string& name) {
    if (table.has("column"))
        table.fail("column", table.full("column") +
                                 " is for .csv and .mat files; a field of a CAN frame has id, "
                                 "start_bit, length");
    const long line = long(table.raw().source().begin.line);
    return {name, meaning_of(name, table.file(), line), read_field(table, name)};
}

// The signals of a profile, for a map that says `profile` instead of [signals].
FrameMap of_profile(const TomlView& bus) {
    const std::string profile = bus.text("profile");
    if (profile != "cia402" && profile != "servoid")
        bus.fail("profile", bus.full("profile") + " must be cia402 or servoid");
    const int node = bus.has("node") ? int(whole(bus, "node", 1, 127)) : 1;
    if (profile == "servoid") return map_of_telemetry(node);
    const int tpdo = bus.has("tpdo") ? int(whole(bus, "tpdo", 1, 4)) : 1;
    return map_of_cia402(node, tpdo, bus.has("objects") ? bus.texts("objects") : default_objects());
}

void read_bus(const TomlView& bus, FrameMap& map) {
    bus.allow_only({"sync", "extended", "counter", "time", "period_s", "interface", "profile",
                    "node", "tpdo", "objects"});
    if (bus.has("sync")) map.sync = frame_id(bus, "sync");
    if (bus.has("counter")) map.counter = read_field(bus.table("counter"), "counter");
    if (bus.has("time")) map.device_time = read_field(bus.table("time"), "time");
    if (bus.has("period_s")) map.period_s = bus.positive("period_s");
    map.interface = bus.text_or("interface", "");
}

std::string suffix_of(const std::string& unit) {
    static const std::map<std::string, std::string> known = {
        {"Nm", "_Nm"},       {"N·m", "_Nm"},      {"mNm", "_mNm"},           {"N", "_N"},
        {"A", "_A"},         {"rad", "_rad"},     {"rev", "_rev"},           {"deg", "_deg"},
        {"count", "_count"}, {"inc", "_count"},   {"counts", "_count"},      {"m", "_m"},
        {"mm", "_mm"},       {"rad/s", "_rad_s"}, {"rpm", "_rpm"},           {"1/min", "_rpm"},
        {"m/s", "_m_s"},     {"mm/s", "_mm_s"},   {"permille", "_permille"}, {"‰", "_permille"}};
    const auto found = known.find(unit);
    return found == known.end() ? "" : found->second;
}

MappedSignal mapped(const Dbc& dbc, const std::string& name, const std::string& said) {
    const std::size_t colon = said.find(':');
    const DbcSignal& signal = find_signal(dbc, said.substr(0, colon));
    const std::string unit = colon == std::string::npos ? signal.unit : said.substr(colon + 1);
    const std::string column = name + suffix_of(unit);
    if (suffix_of(unit).empty() || !find_column(column))
        throw FileError(dbc.path, signal.line,
                        fmt::format("the unit {} says nothing of a {}; name one: {}:UNIT",
                                    in_quotes(unit), name, said.substr(0, colon)));
    return {column, *find_column(column), signal.field};
}

struct Object {
    const char* index;
    int bits;
    const char* column; // "": its bits are passed over
};

// Objects of CiA 402-2 that a drive sends in a TPDO.
constexpr Object kObjects[] = {{"6041", 16, ""},
                               {"6061", 8, ""},
                               {"603F", 16, ""},
                               {"6062", 32, "position_ref_count"},
                               {"6064", 32, "position_count"},
                               {"606C", 32, ""},
                               {"6074", 16, "torque_ref_permille"},
                               {"6077", 16, "torque_permille"}};

} // namespace

const std::vector<std::string>& default_objects() {
    static const std::vector<std::string> objects = {"6041", "6064", "6077"};
    return objects;
}

std::vector<FrameId> data_identifiers(const FrameMap& map) {
    std::set<FrameId> out;
    if (map.telemetry_node) out.insert(telemetry_id(*map.telemetry_node));
    for (const MappedSignal& s : map.signals)
        out.insert(s.field.frame);
    if (map.counter) out.insert(map.counter->frame);
    if (map.device_time) out.insert(map.device_time->frame);
    return {out.begin(), out.end()};
}

std::vector<FrameId> mapped_identifiers(const FrameMap& map) {
    std::vector<FrameId> out = data_identifiers(map);
    if (map.sync && std::find(out.begin(), out.end(), *map.sync) == out.end())
        out.push_back(*map.sync);
    return out;
}

void check_map(const FrameMap& map) {
    if (map.telemetry_node) return;
    std::vector<const Field*> fields;
    for (const MappedSignal& s : map.signals)
        fields.push_back(&s.field);
    if (map.counter) fields.push_back(&*map.counter);
    if (map.device_time) fields.push_back(&*map.device_time);
    for (std::size_t i = 0; i < fields.size(); ++i)
        for (std::size_t j = i + 1; j < fields.size(); ++j)
            if (overlap(*fields[i], *fields[j]))
                throw FileError(map.path, 0,
                                fmt::format("{} and {} share bits of frame {}", fields[i]->name,
                                            fields[j]->name, to_text(fields[i]->frame)));
    if (map.signals.empty())
        throw FileError(map.path, 0, "no signal is mapped; expected [signals.torque] and others");
}

FrameMap read_frame_map(const std::string& path) {
    const toml::table document = parse_toml(read_file(path), path);
    const TomlView root(document, path, "");
    root.allow_only({"signals", "bus", "metadata"});
    FrameMap map;
    if (root.has("bus") && root.table("bus").has("profile")) map = of_profile(root.table("bus"));
    map.path = path;
    if (root.has("signals")) {
        const TomlView signals = root.table("signals");
        for (const std::string& name : signals.keys())
            map.signals.push_back(read_signal(signals.table(name), name));
    }
    if (root.has("bus")) read_bus(root.table("bus"), map);
    if (root.has("metadata")) map.metadata = root.table("metadata").as_texts();
    check_map(map);
    return map;
}

FrameMap map_from_dbc(const std::string& path, const std::map<std::string, std::string>& signals) {
    const Dbc dbc = read_dbc(path);
    FrameMap map;
    map.path = path;
    for (const auto& [name, said] : signals)
        map.signals.push_back(mapped(dbc, name, said));
    check_map(map);
    return map;
}

FrameMap map_of_telemetry(int node) {
    FrameMap map;
    map.path = "the telemetry of a servoid drive";
    map.telemetry_node = node;
    return map;
}

FrameMap map_of_cia402(int node, int tpdo, const std::vector<std::string>& objects) {
    FrameMap map;
    map.cia402_node = node;
    map.path = "cia402";
    map.sync = FrameId{0x80, false};
    const FrameId frame{std::uint32_t(0x80 + 0x100 * tpdo + node), false};
    int bit = 0;
    for (const std::string& index : objects) {
        const auto* known = std::find_if(std::begin(kObjects), std::end(kObjects),
                                         [&](const Object& o) { return index == o.index; });
        if (known == std::end(kObjects))
            throw UsageError("--objects: " + in_quotes(index) +
                             " is no object of a TPDO that is known here; 6041, 6061, 603F, 6062, "
                             "6064, 606C, 6074, 6077 are");
        if (known->column[0] != '\0')
            map.signals.push_back({known->column,
                                   *find_column(known->column),
                                   {known->column, frame, bit, known->bits, ByteOrder::little,
                                    FieldKind::signed_integer, 1, 0}});
        bit += known->bits;
    }
    if (bit > 64) throw UsageError(fmt::format("--objects: {} bits; a TPDO holds 64", bit));
    check_map(map);
    return map;
}

} // namespace servoid::can
