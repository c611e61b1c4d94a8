// TOML with messages: every wrong key, type and value is named with its file and line.
#pragma once

#include "common/toml.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace servoid {

// Throws FileError on a syntax error.
toml::table parse_toml(const std::string& text, const std::string& file);

// One table of a file. Refers to the table and the strings it was made from: keep those alive.
class TomlView {
  public:
    TomlView(const toml::table& table, std::string file, std::string path)
        : table_(&table), file_(std::move(file)), path_(std::move(path)) {}

    bool has(const std::string& key) const { return table_->contains(key); }
    const toml::table& raw() const { return *table_; }
    const std::string& file() const { return file_; }
    const std::string& path() const { return path_; }
    std::vector<std::string> keys() const; // in the order of the file

    double number(const std::string& key) const; // finite; integers too
    double positive(const std::string& key) const;
    double positive_or(const std::string& key, double fallback) const;
    std::string text(const std::string& key) const;
    std::string text_or(const std::string& key, const std::string& fallback) const;
    std::vector<std::string> texts(const std::string& key) const; // empty where there is no key
    TomlView table(const std::string& key) const;
    std::map<std::string, std::string> as_texts() const; // all of it: strings, and numbers as text

    // Throws where the table has a key that is not in the list.
    void allow_only(const std::vector<std::string>& known) const;

    // Both throw FileError: at the line of the key, or of the table where there is no such key.
    [[noreturn]] void fail(const std::string& key, const std::string& reason) const;
    [[noreturn]] void fail(const std::string& reason) const;

    std::string full(const std::string& key) const {
        return path_.empty() ? key : path_ + "." + key;
    }

  private:
    const toml::node& node(const std::string& key) const; // throws where it is missing
    const toml::table* table_;
    std::string file_, path_;
};

// "a string", "an array", ...: what stands there instead of what was expected.
std::string kind_of(const toml::node& node);

} // namespace servoid
