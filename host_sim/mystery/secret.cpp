#include "mystery/secret.hpp"

#include "capture/csv_reader.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/text.hpp"
#include "common/toml_view.hpp"
#include "effects/catalogue.hpp"

#include <charconv>
#include <string_view>

namespace servoid {

namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string table_of(const Mystery& m) {
    std::string out = "seed = \"" + std::to_string(m.seed) + "\"\n";
    out += std::string("motion = \"") + (m.motion == Motion::linear ? "linear" : "rotary") + "\"\n";
    out += "effect = \"" + m.hidden.name + "\"\n";
    out += "share = " + format_number(m.share) + "\n";
    out += "band_Hz = " + format_number(m.band_Hz) + "\n";
    out += "[parameters]\n";
    for (const auto& [key, value] : m.hidden.parameters)
        out += key + " = " + format_number(value) + "\n";
    return out;
}

std::uint64_t seed_of(const TomlView& root) {
    const std::string text = root.text("seed"); // text: TOML's integers end at 2^63
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (error != std::errc() || end != text.data() + text.size())
        root.fail("seed", "seed is no whole number");
    return seed;
}

Mystery mystery_of(const TomlView& root) {
    root.allow_only({"seed", "motion", "effect", "share", "band_Hz", "parameters"});
    Mystery m;
    m.seed = seed_of(root);
    m.motion = root.text("motion") == "linear" ? Motion::linear : Motion::rotary;
    m.share = root.number("share"), m.band_Hz = root.number("band_Hz");
    m.hidden.name = root.text("effect");
    const Effect* effect = find_effect(m.hidden.name);
    if (!effect) root.fail("effect", "no effect is called " + in_quotes(m.hidden.name));
    const TomlView parameters = root.table("parameters");
    for (const ParameterInfo& p : effect->info().parameters)
        m.hidden.parameters[p.key] = parameters.number(p.key);
    return m;
}

} // namespace

std::string base64(const std::string& bytes) {
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        unsigned word = 0;
        for (size_t k = 0; k < 3; ++k)
            word =
                word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63];
    }
    return out;
}

std::string from_base64(const std::string& text) {
    std::string out;
    if (text.size() % 4 != 0) return out;
    unsigned word = 0, bits = 0;
    for (const char c : std::string_view(text).substr(0, text.find('='))) {
        const size_t digit = kDigits.find(c);
        if (digit == std::string_view::npos) return "";
        word = (word << 6 | unsigned(digit)) & 0xFFFFFF, bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        out += char(word >> bits & 0xFF);
    }
    return out;
}

std::string encode_secret(const Mystery& mystery) { return base64(table_of(mystery)); }

Mystery decode_secret(const std::string& text, const std::string& file, long line) {
    const std::string table = from_base64(text);
    const std::string wrong = std::string(kSecretKey) + " is damaged: ";
    if (table.empty()) throw FileError(file, line, wrong + "it is not base64");
    try {
        const toml::table document = parse_toml(table, "secret");
        return mystery_of(TomlView(document, "secret", ""));
    } catch (const FileError& e) {
        throw FileError(file, line, wrong + e.what());
    }
}

Mystery read_mystery(const std::string& path) {
    const RawTable table = read_csv(read_file(path), path, nullptr);
    const auto found = table.metadata.find(kSecretKey);
    if (found == table.metadata.end())
        throw FileError(path, 0,
                        std::string("no mystery is hidden in this capture; expected the line `# ") +
                            kSecretKey + " = ...` that `servoid simulate --mystery` writes");
    return decode_secret(found->second.value, path, found->second.line);
}

} // namespace servoid
