#include "common/toml_view.hpp"

#include "common/error.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

long line_of(const toml::node& node) { return static_cast<long>(node.source().begin.line); }

} // namespace

toml::table parse_toml(const std::string& text, const std::string& file) {
    if (text.find('\0') != std::string::npos)
        throw FileError(file, 0, "holds binary data; a TOML text was expected");
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        throw FileError(file, static_cast<long>(error.source().begin.line),
                        "not valid TOML: " + std::string(error.description()));
    }
}

std::string kind_of(const toml::node& node) {
    switch (node.type()) {
    case toml::node_type::table:
        return "a table";
    case toml::node_type::array:
        return "an array";
    case toml::node_type::string:
        return "a string";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
        return "a number";
    case toml::node_type::boolean:
        return "a boolean";
    default:
        return "a date or time";
    }
}

std::vector<std::string> TomlView::keys() const {
    std::vector<std::pair<toml::source_position, std::string>> found;
    for (const auto& [key, value] : *table_)
        found.emplace_back(key.source().begin, std::string(key.str()));
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> names;
    for (auto& entry : found)
        names.push_back(std::move(entry.second));
    return names;
}

void TomlView::fail(const std::string& reason) const {
    throw FileError(file_, line_of(*table_), reason);
}

void TomlView::fail(const std::string& key, const std::string& reason) const {
    const auto found = table_->find(key);
    if (found == table_->end()) fail(reason);
    throw FileError(file_, static_cast<long>(found->first.source().begin.line), reason);
}

const toml::node& TomlView::node(const std::string& key) const {
    const toml::node* found = table_->get(key);
    if (!found) fail("missing key \"" + full(key) + "\"");
    return *found;
}

double TomlView::number(const std::string& key) const {
    const toml::node& found = node(key);
    if (!found.is_number()) fail(key, full(key) + " must be a number, not " + kind_of(found));
    const double value = found.value<double>().value();
    if (!std::isfinite(value)) fail(key, full(key) + " must be finite");
    return value;
}

double TomlView::positive(const std::string& key) const {
    const double value = number(key);
    if (value <= 0) fail(key, full(key) + " must be above zero, not " + format_number(value));
    return value;
}

double TomlView::positive_or(const std::string& key, double fallback) const {
    return has(key) ? positive(key) : fallback;
}

std::string TomlView::text(const std::string& key) const {
    const toml::node& found = node(key);
    if (!found.is_string()) fail(key, full(key) + " must be a string, not " + kind_of(found));
    return found.value<std::string>().value();
}

std::string TomlView::text_or(const std::string& key, const std::string& fallback) const {
    return has(key) ? text(key) : fallback;
}

std::vector<std::string> TomlView::texts(const std::string& key) const {
    std::vector<std::string> list;
    if (!has(key)) return list;
    const toml::array* array = table_->get(key)->as_array();
    if (!array)
        fail(key, full(key) + " must be an array of strings, not " + kind_of(*table_->get(key)));
    for (const auto& element : *array) {
        if (!element.is_string())
            throw FileError(file_, line_of(element),
                            full(key) + " must hold strings, not " + kind_of(element));
        list.push_back(element.value<std::string>().value());
    }
    return list;
}

TomlView TomlView::table(const std::string& key) const {
    const toml::node& found = node(key);
    if (!found.is_table()) fail(key, "[" + full(key) + "] must be a table, not " + kind_of(found));
    return {*found.as_table(), file_, full(key)};
}

std::map<std::string, std::string> TomlView::as_texts() const {
    std::map<std::string, std::string> out;
    for (const std::string& key : keys()) {
        const toml::node& value = node(key);
        if (value.is_string())
            out[key] = text(key);
        else if (value.is_number())
            out[key] = format_number(number(key));
        else
            fail(key, full(key) + " must be a string or a number, not " + kind_of(value));
    }
    return out;
}

void TomlView::allow_only(const std::vector<std::string>& known) const {
    for (const auto& key : keys())
        if (std::find(known.begin(), known.end(), key) == known.end())
            fail(key, "unknown key " + in_quotes(full(key)) + suggestion(key, known));
}

} // namespace servoid
